#include "render/layers/field_layer.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/render/picture.h"

namespace clatter {

TEST_CASE("Each cell of a field has its colour up to its edges, and a gap none") {
  const auto context = open_context(Backend::Osmesa);
  const Size size{60, 40};
  const Canvas canvas = blank_canvas(context->gl(), size);
  const FieldMap field{Field::Density, {3, 2}, {0.0, 0.2, 0.4, 0.6, std::nan(""), 1.0}};
  const ColourScale scale{colour_map(Palette::Inferno)};
  FieldLayer(context->gl()).draw(field, {3.0, 2.0}, {{{1.5, 1.0}, 3.0}, size}, scale);

  const Image image = canvas.read();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double value = field.values[3 * (1 - y / 20) + x / 20];
      const Colour expected = std::isnan(value) ? theme::kBackground : scale(value);
      REQUIRE(pixel(image, x, y) == expected);
    }
  }
}

}  // namespace clatter
