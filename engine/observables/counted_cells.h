#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/scene/observable_settings.h"
#include "engine/vec.h"

namespace clatter {

/// Equal cells that fill a box, for counting the centres in them.
class CountedCells {
 public:
  /// The most cells with at least the edge of the settings.
  CountedCells(const VecX& box, const CellSettings& settings) : dimension_(box.size()) {
    for (Eigen::Index axis = 0; axis < dimension_; ++axis) {
      counts_[axis] = settings.cells_along(box[axis]);
    }
  }

  /// Number of cells.
  std::size_t size() const { return static_cast<std::size_t>(counts_.head(dimension_).prod()); }

  /// The cell of a position in the present box. Rounding may put a position at the upper edge of
  /// the box, or a centre beyond a moving wall; it is in the last cell there.
  template <class Position, class Box>
  std::size_t of(const Position& position, const Box& box) const {
    double cell = 0.0;
    for (Eigen::Index axis = 0; axis < dimension_; ++axis) {
      const double place = position[axis] / box[axis] * counts_[axis];
      cell = cell * counts_[axis] + std::clamp(std::floor(place), 0.0, counts_[axis] - 1.0);
    }
    return static_cast<std::size_t>(cell);
  }

 private:
  Eigen::Index dimension_;
  Vec<3> counts_;  // along each axis
};

}  // namespace clatter
