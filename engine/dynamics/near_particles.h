#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/laws/domain.h"
#include "engine/vec.h"

namespace clatter {

/// Particles at rest, to find those near a point, with their periodic images. Memory and time grow
/// with the particles, not with the box, however they are spread.
template <int D>
class NearParticles {
 public:
  /// No particles yet. The search finds those within `range`.
  NearParticles(const Domain<D>& domain, double range) : domain_(domain) {
    constexpr double kMargin = 1.01;  // exceeds any rounding of positions
    for (int axis = 0; axis < D; ++axis) {
      const double cells = std::floor(domain.box[axis] / (kMargin * range));
      counts_[axis] = static_cast<std::int64_t>(std::max(1.0, cells));
    }
  }

  /// Adds a particle. Its number is that of the particles before it. Beyond a wall it belongs to
  /// the nearest cell.
  void add(const Vec<D>& position) {
    const auto number = static_cast<std::uint32_t>(positions_.size());
    next_.push_back(
        std::exchange(first_.try_emplace(key(cell_at(position)), kNone).first->second, number));
    positions_.push_back(position);
  }
  /// [particles] in the order in which they were added.
  const std::vector<Vec<D>>& positions() const { return positions_; }
  /// The positions. No particles remain.
  std::vector<Vec<D>> take() {
    first_.clear();
    next_.clear();
    return std::exchange(positions_, {});
  }

  /// Calls visit(particle, way) for each particle within the range of a point, and for some beyond
  /// it; along periodic axes for its images in the box and in the two next to it. `way` goes from
  /// the point to the image.
  template <class Visit>
  void visit(const Vec<D>& point, const Visit& visit) const {
    if (domain_.sheared) return visit_sheared(point, visit);
    const Cell own = cell_at(point);
    Cell step = Cell::Constant(-1);
    while (step[D - 1] <= 1) {
      visit_cell(own + step, point, visit);
      for (int axis = 0; ++step[axis] > 1 && axis < D - 1; ++axis) step[axis] = -1;
    }
  }
  /// Whether a particle or an image is closer to a point than a distance within the range.
  bool any_within(const Vec<D>& point, double distance) const {
    bool any = false;
    visit(point, [&](std::uint32_t, const Vec<D>& way) { any = any || way.norm() < distance; });
    return any;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  using Cell = Eigen::Matrix<std::int64_t, D, 1>;

  Cell cell_at(const Vec<D>& position) const {
    Cell cell;
    for (int axis = 0; axis < D; ++axis) {
      const double share = position[axis] / domain_.box[axis];
      const auto along = static_cast<std::int64_t>(share * static_cast<double>(counts_[axis]));
      cell[axis] = std::clamp<std::int64_t>(along, 0, counts_[axis] - 1);
    }
    return cell;
  }

  std::int64_t key(const Cell& cell) const {
    std::int64_t key = 0;
    for (int axis = D - 1; axis >= 0; --axis) key = key * counts_[axis] + cell[axis];
    return key;
  }

  // The images above and below slide, so the cells around the point's place among them are visited.
  template <class Visit>
  void visit_sheared(const Vec<D>& point, const Visit& visit) const {
    const double height = domain_.box[1] / static_cast<double>(counts_[1]);
    for (const double above : {-1.0, 0.0, 1.0}) {
      Vec<D> seen = point - domain_.shift(above * Vec<D>::Unit(1));
      seen[0] -= std::floor(seen[0] / domain_.box[0]) * domain_.box[0];
      Cell own = cell_at(seen), step = Cell::Constant(-1);
      own[1] = static_cast<std::int64_t>(std::floor(seen[1] / height));
      while (step[D - 1] <= 1) {
        const Cell cell = own + step;
        if (cell[1] >= 0 && cell[1] < counts_[1]) visit_cell(cell, seen, visit);
        for (int axis = 0; ++step[axis] > 1 && axis < D - 1; ++axis) step[axis] = -1;
      }
    }
  }

  // The particles of a cell, which may be one beyond the box.
  template <class Visit>
  void visit_cell(Cell cell, const Vec<D>& point, const Visit& visit) const {
    Vec<D> image = Vec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      const int beyond = cell[axis] < 0 ? -1 : cell[axis] >= counts_[axis] ? 1 : 0;
      if (beyond != 0 && !domain_.periodic[axis]) return;
      cell[axis] -= beyond * counts_[axis];
      image[axis] = beyond;
    }
    const auto found = first_.find(key(cell));
    if (found == first_.end()) return;
    const Vec<D> from = point - domain_.shift(image);
    for (std::uint32_t k = found->second; k != kNone; k = next_[k]) {
      visit(k, Vec<D>(positions_[k] - from));
    }
  }

  Domain<D> domain_;
  Cell counts_;                                            // of cells along each axis
  std::unordered_map<std::int64_t, std::uint32_t> first_;  // the last particle added to each cell
  std::vector<std::uint32_t> next_;                        // [N] the one added to its cell before
  std::vector<Vec<D>> positions_;
};

}  // namespace clatter
