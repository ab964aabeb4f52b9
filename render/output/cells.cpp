#include "render/output/cells.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace clatter {

PictureCell picture_cell(Size whole, int number, int count) {
  const int columns = count == 4 ? 2 : count, rows = count == 4 ? 2 : 1;
  const int column = number % columns, row = number / columns;
  const int left = column * whole.width / columns, top = row * whole.height / rows;
  const int right = (column + 1) * whole.width / columns;
  const int bottom = (row + 1) * whole.height / rows;
  return {left, top, {right - left, bottom - top}};
}

PlotSplit split_for_plots(Size whole) {
  constexpr double kShare = 0.3;
  if (whole.width >= whole.height) {
    const int gases = whole.width - static_cast<int>(kShare * whole.width);
    return {{0, 0, {gases, whole.height}}, {gases, 0, {whole.width - gases, whole.height}}};
  }
  const int gases = whole.height - static_cast<int>(kShare * whole.height);
  return {{0, 0, {whole.width, gases}}, {0, gases, {whole.width, whole.height - gases}}};
}

Image joined(Size whole, const std::vector<PlacedPicture>& parts) {
  constexpr std::size_t kChannels = 4;
  const auto row_bytes = [](int pixels) { return kChannels * static_cast<std::size_t>(pixels); };
  Image picture{whole, std::vector<unsigned char>(row_bytes(whole.width) *
                                                  static_cast<std::size_t>(whole.height))};
  for (const auto& [cell, part] : parts) {
    const std::size_t length = row_bytes(cell.size.width);
    const unsigned char* from = part.rgba.data();
    for (int y = 0; y < cell.size.height; ++y, from += length) {
      const std::size_t to =
          row_bytes(whole.width) * static_cast<std::size_t>(cell.top + y) + row_bytes(cell.left);
      std::copy_n(from, length, picture.rgba.data() + to);
    }
  }
  return picture;
}

Image joined_cells(Size whole, std::vector<Image> cells) {
  const auto count = static_cast<int>(cells.size());
  if (count == 1) return std::move(cells.front());
  std::vector<PlacedPicture> parts;
  for (int number = 0; number < count; ++number) {
    parts.push_back(
        {picture_cell(whole, number, count), std::move(cells[static_cast<std::size_t>(number)])});
  }
  return joined(whole, parts);
}

}  // namespace clatter
