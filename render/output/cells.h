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

/// The parts of a picture with plots.
struct PlotSplit {
  PictureCell gases, plots;
};

/// The parts of a picture of `whole` size: the plots are right of the gases, or below them if the
/// picture is higher than wide.
PlotSplit split_for_plots(Size whole);

/// A picture at the place of a cell of its size.
struct PlacedPicture {
  PictureCell cell;
  Image picture;
};

/// The picture of `whole` size with these parts.
Image joined(Size whole, const std::vector<PlacedPicture>& parts);

/// The picture of `whole` size with these cells.
Image joined_cells(Size whole, std::vector<Image> cells);

}  // namespace clatter
