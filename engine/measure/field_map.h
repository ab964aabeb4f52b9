#pragma once

#include <array>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// A field on a grid of equal box cells over the whole box, Sec. 4.
struct FieldMap {
  Field field;
  std::array<int, 2> cells = {0, 0};  ///< along x and y
  std::vector<double> values;  ///< [cells_y][cells_x], row by row from y = 0; NaN: never visited
  bool whole_window = false;   ///< averaged over the whole window, not less for want of time
};

}  // namespace clatter
