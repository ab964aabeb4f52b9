#pragma once

#include <vector>

#include "render/output/image.h"

namespace clatter {

/// The largest number of cells in a picture.
inline constexpr int kMostCells = 4;

/// A part of a picture that shows one gas.
struct PictureCell {
  int left, top;  ///< pixels from the upper left corner of the picture
  Size size;
};

/// Cell `number` of `count` in a picture of `whole` size. Cells are in a row; four are in two rows.
PictureCell picture_cell(Size whole, int number, int count);

/// The picture of `whole` size with these cells.
Image joined_cells(Size whole, const std::vector<Image>& cells);

}  // namespace clatter
