#pragma once

#include <array>
#include <vector>

#include "engine/scene/field.h"

namespace clatter {

/// A field on a grid of equal box cells over the whole box, Sec. 4.
struct FieldMap {
  Field field;
  std::vector<int> cells = {0, 0};  ///< [D] along each axis
  std::vector<double>
      values;  ///< [cells_z][cells_y][cells_x], of disks without the first; NaN: never visited
  bool whole_window = false;  ///< averaged over the whole window, not less for want of time
};

}  // namespace clatter
