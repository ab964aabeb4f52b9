#include "render/neighbour_shade.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clatter {

namespace {

constexpr double kReach = 1.75;  // diameters

// Cells of at least the reach, each with the list of its spheres.
class Cells {
 public:
  Cells(std::span<const Vec<3>> centres, double reach) : width_(reach) {
    constexpr int kMaxCells = 128;  // along an axis: bounds the memory of sparse gases
    Vec<3> high = low_ = centres.front();
    for (const Vec<3>& centre : centres) {
      low_ = low_.cwiseMin(centre);
      high = high.cwiseMax(centre);
    }
    for (int axis = 0; axis < 3; ++axis) {
      width_ = std::max(width_, (high[axis] - low_[axis]) / kMaxCells);
    }
    counts_ = ((high - low_) / width_).cast<int>() + IntVec<3>::Ones();
    first_.resize(static_cast<std::size_t>(counts_.prod()) + 1);
    members_.resize(centres.size());
    for (const Vec<3>& centre : centres) ++first_[index(cell(centre)) + 1];
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < centres.size(); ++i)
      members_[next[index(cell(centres[i]))]++] = i;
  }

  // Calls `visit` with the number of each sphere in the cells around a position.
  template <class Visit>
  void visit_near(const Vec<3>& position, Visit visit) const {
    const IntVec<3> middle = cell(position);
    const IntVec<3> from = (middle.array() - 1).max(0);
    const IntVec<3> to = (middle.array() + 1).min(counts_.array() - 1);
    for (int z = from.z(); z <= to.z(); ++z) {
      for (int y = from.y(); y <= to.y(); ++y) {
        // Cells along x are adjacent in memory.
        const std::uint32_t begin = first_[index({from.x(), y, z})];
        const std::uint32_t end = first_[index({to.x(), y, z}) + 1];
        for (std::uint32_t k = begin; k < end; ++k) visit(members_[k]);
      }
    }
  }

 private:
  IntVec<3> cell(const Vec<3>& position) const {
    return ((position - low_) / width_).cast<int>().cwiseMin(counts_ - IntVec<3>::Ones());
  }
  std::size_t index(const IntVec<3>& cell) const {
    return static_cast<std::size_t>(cell.x()) +
           static_cast<std::size_t>(counts_.x()) *
               (static_cast<std::size_t>(cell.y()) +
                static_cast<std::size_t>(counts_.y()) * static_cast<std::size_t>(cell.z()));
  }

  double width_;
  Vec<3> low_;
  IntVec<3> counts_;
  std::vector<std::uint32_t> first_, members_;
};

void add(NeighbourShade& shade, const Vec<3>& offset, double distance, double diameter) {
  // The weight fades out, so that a neighbour that leaves does not change the light at once.
  const double reach = kReach * diameter;
  const double fade = std::min(1.0, 4.0 * (1.0 - distance / reach));
  const auto weight = static_cast<float>(0.5 * fade * diameter * diameter / (distance * distance));
  const Eigen::Vector3f u = (offset / distance).cast<float>();
  shade.weight += weight;
  shade.direction += weight * u;
  shade.squares += weight * u.cwiseProduct(u);
  shade.products += weight * Eigen::Vector3f(u.x() * u.y(), u.x() * u.z(), u.y() * u.z());
}

}  // namespace

std::vector<NeighbourShade> neighbour_shades(std::span<const Vec<3>> centres,
                                             std::span<const std::uint32_t> wanted,
                                             double diameter) {
  std::vector<NeighbourShade> shades(wanted.size());
  if (wanted.empty()) return shades;
  const double reach = kReach * diameter;
  const Cells cells(centres, reach);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const Vec<3>& centre = centres[wanted[k]];
    cells.visit_near(centre, [&](std::uint32_t j) {
      const Vec<3> offset = centres[j] - centre;
      const double square = offset.squaredNorm();
      if (square >= reach * reach || square == 0.0) return;
      add(shades[k], offset, std::sqrt(square), diameter);
    });
  }
  return shades;
}

}  // namespace clatter
