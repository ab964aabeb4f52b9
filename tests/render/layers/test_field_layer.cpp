#include <doctest/doctest.h>

#include <cmath>

#include "render/layers/field_layer.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE(
    "Field layer: each cell of a field has its colour up to its edges, and a gap is hatched") {
  constexpr Colour kGap = {0xff, 0x00, 0x00};
  const auto context = open_context(Backend::Osmesa);
  const Size size{60, 40};
  const Canvas canvas = blank_canvas(context->gl(), size);
  const FieldMap field{Quantity::Density, {3, 2}, {0.0, 0.2, 0.4, 0.6, std::nan(""), 1.0}};
  const ColourScale scale{colour_map(Palette::Inferno)};
  FieldLayer(context->gl()).draw(field, {3.0, 2.0}, {{{1.5, 1.0}, 3.0}, size}, scale, kGap);

  const Image image = canvas.read();
  int hatched = 0, bare = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double value = field.values[3 * (1 - y / 20) + x / 20];
      if (!std::isnan(value)) REQUIRE(pixel(image, x, y) == scale(value));
      // The gap, without its border.
      if (!std::isnan(value) || x < 21 || x > 38 || y < 1 || y > 18) continue;
      bare += pixel(image, x, y) == kDarkTheme.background;
      hatched += difference(pixel(image, x, y), kGap) < 80;
    }
  }
  CHECK(bare > 50);
  CHECK(hatched > 20);
}

}  // namespace clatter
