#include "render/output/cells.h"

#include <algorithm>
#include <cstddef>

namespace clatter {

PictureCell picture_cell(Size whole, int number, int count) {
  const int columns = count == 4 ? 2 : count, rows = count == 4 ? 2 : 1;
  const int column = number % columns, row = number / columns;
  const int left = column * whole.width / columns, top = row * whole.height / rows;
  const int right = (column + 1) * whole.width / columns;
  const int bottom = (row + 1) * whole.height / rows;
  return {left, top, {right - left, bottom - top}};
}

Image joined_cells(Size whole, const std::vector<Image>& cells) {
  constexpr std::size_t kChannels = 4;
  const auto row_bytes = [](int pixels) { return kChannels * static_cast<std::size_t>(pixels); };
  Image picture{whole, std::vector<unsigned char>(row_bytes(whole.width) *
                                                  static_cast<std::size_t>(whole.height))};
  const auto count = static_cast<int>(cells.size());
  for (int number = 0; number < count; ++number) {
    const PictureCell place = picture_cell(whole, number, count);
    const std::size_t length = row_bytes(place.size.width);
    const unsigned char* from = cells[static_cast<std::size_t>(number)].rgba.data();
    for (int y = 0; y < place.size.height; ++y, from += length) {
      const std::size_t to =
          row_bytes(whole.width) * static_cast<std::size_t>(place.top + y) + row_bytes(place.left);
      std::copy_n(from, length, picture.rgba.data() + to);
    }
  }
  return picture;
}

}  // namespace clatter
