#pragma once

#include <algorithm>
#include <cmath>

#include "engine/vec.h"

namespace clatter {

/// The cell of a position, for cells of the edges `widths` and their numbers `counts` along each
/// axis. Positions outside of the cells belong to the nearest one.
template <int D>
IntVec<D> cell_of(const Vec<D>& position, const Vec<D>& widths, const IntVec<D>& counts) {
  IntVec<D> cell;
  for (int axis = 0; axis < D; ++axis) {
    const int at = static_cast<int>(std::floor(position[axis] / widths[axis]));
    cell[axis] = std::clamp(at, 0, counts[axis] - 1);
  }
  return cell;
}

}  // namespace clatter
