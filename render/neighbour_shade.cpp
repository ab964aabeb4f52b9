#include "render/neighbour_shade.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

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

  // Calls `visit` with the number of each sphere in the cells around a position, up to a distance.
  template <class Visit>
  void visit_near(const Vec<3>& position, double distance, Visit visit) const {
    const IntVec<3> middle = cell(position);
    const int cells = static_cast<int>(std::ceil(distance / width_));
    const IntVec<3> from = (middle.array() - cells).max(0);
    const IntVec<3> to = (middle.array() + cells).min(counts_.array() - 1);
    if ((to.array() < from.array()).any()) return;  // the position is far outside
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

// Spheres whose radii differ by a factor of 2 at most, with cells of the size of the largest. So
// each sphere visits few cells with few spheres too far away.
struct SizeClass {
  double largest;  // radius
  std::span<const Vec<3>> centres;
  std::span<const double> radii;  // one of each, or one for all
  Cells cells;

  SizeClass(double most, std::span<const Vec<3>> places, std::span<const double> of_each)
      : largest(most), centres(places), radii(of_each), cells(places, kReach * 2.0 * most) {}

  double radius(std::uint32_t k) const { return radii.size() == 1 ? radii[0] : radii[k]; }
};

// The shade by one neighbour. `equal` is the distance at which the spheres would have the same gap
// if they were equal, `factor` that of the weight.
void add(NeighbourShade& shade, const Vec<3>& offset, double distance, double equal, double factor,
         double diameter) {
  // The weight fades out, so that a neighbour that leaves does not change the light at once.
  const double reach = kReach * diameter;
  const double fade = std::min(1.0, 4.0 * (1.0 - equal / reach));
  const auto weight =
      static_cast<float>(factor * fade * diameter * diameter / (distance * distance));
  const Eigen::Vector3f u = (offset / distance).cast<float>();
  shade.weight += weight;
  shade.direction += weight * u;
  shade.squares += weight * u.cwiseProduct(u);
  shade.products += weight * Eigen::Vector3f(u.x() * u.y(), u.x() * u.z(), u.y() * u.z());
}

// Adds the shade of the spheres of a class on a sphere.
void add(NeighbourShade& shade, const Vec<3>& centre, double radius, const SizeClass& of) {
  const double farthest = kReach * 2.0 * of.largest + std::max(radius - of.largest, 0.0);
  of.cells.visit_near(centre, farthest, [&](std::uint32_t j) {
    const Vec<3> offset = of.centres[j] - centre;
    const double square = offset.squaredNorm(), other = of.radius(j);
    const double reach = kReach * 2.0 * other + (radius - other);
    if (square >= reach * reach || square == 0.0) return;
    const double distance = std::sqrt(square);
    const double factor = radius < other ? 0.25 * (1.0 + radius / other) : 0.5;
    add(shade, offset, distance, distance - (radius - other), factor, 2.0 * other);
  });
}

// The centres and radii of the spheres of a class, in order.
struct Members {
  std::vector<Vec<3>> centres;
  std::vector<double> radii;
};

std::map<int, Members> members_by_size(std::span<const Vec<3>> centres,
                                       std::span<const double> radii) {
  const double largest = *std::ranges::max_element(radii);
  std::map<int, Members> classes;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    Members& members = classes[static_cast<int>(std::log2(largest / radii[i]))];
    members.centres.push_back(centres[i]);
    members.radii.push_back(radii[i]);
  }
  return classes;
}

}  // namespace

std::vector<NeighbourShade> neighbour_shades(std::span<const Vec<3>> centres,
                                             std::span<const double> radii,
                                             std::span<const std::uint32_t> wanted) {
  std::vector<NeighbourShade> shades(wanted.size());
  if (wanted.empty()) return shades;
  std::map<int, Members> by_size;
  std::vector<SizeClass> classes;
  if (radii.size() == 1) {
    classes.emplace_back(radii[0], centres, radii);
  } else {
    by_size = members_by_size(centres, radii);
    for (const auto& [number, members] : by_size) {
      classes.emplace_back(*std::ranges::max_element(members.radii), members.centres,
                           members.radii);
    }
  }
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const double radius = radii.size() == 1 ? radii[0] : radii[wanted[k]];
    for (const SizeClass& of : classes) add(shades[k], centres[wanted[k]], radius, of);
  }
  return shades;
}

}  // namespace clatter
