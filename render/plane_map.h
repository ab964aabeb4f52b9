#pragma once

#include <array>
#include <vector>

namespace clatter {

/// Values on a plane grid of equal cells.
struct PlaneMap {
  int width = 0;                    ///< number of cells along the first axis
  int height = 0;                   ///< along the second
  std::array<bool, 2> periodic{};   ///< whether the cells continue beyond the last
  std::vector<double> values = {};  ///< [height][width]; NaN: no value
};

/// A plane map without steps from cell to cell.
struct SmoothMap {
  std::vector<double> values;  ///< [height][width] means of neighbouring cells; NaN: none has one
  std::vector<double> shares;  ///< [height][width] share of cells with a value, 0 to 1
};

/// Means over the neighbours of each cell with binomial weights (1 4 6 4 1)/16 along each axis.
/// Their standard deviation is one cell. Cells without a value do not count. Beyond a border
/// without period the cells are mirrored.
SmoothMap smoothed(const PlaneMap& map);

}  // namespace clatter
