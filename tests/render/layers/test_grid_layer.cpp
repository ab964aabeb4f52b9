#include <doctest/doctest.h>

#include "render/layers/grid_layer.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE(
    "Grid layer: lines of the grid cross the box at equal distances from its corner, as long as "
    "the scale") {
  const auto context = open_context(Backend::Auto);
  const Size size{240, 200};
  const Projection projection{{{10.0, 10.0}, 24.0}, size};  // 10 pixels a unit
  const Canvas canvas = blank_canvas(context->gl(), size);
  Snapshot snapshot;
  snapshot.box = Vec2(20.0, 15.0);
  // A fifth of 200 pixels leaves room for 2 units, not 5.
  REQUIRE(scale_length(projection) == doctest::Approx(2.0));
  constexpr Colour kLine = {0xff, 0xff, 0xff};
  GridLayer(context->gl()).draw(snapshot, projection, kLine);

  const Image image = canvas.read();
  // The box covers the columns 20 to 220 and, from below, the rows 0 to 150.
  for (int x = 0; x < size.width; ++x) {
    CAPTURE(x);
    const bool inside = x > 20 && x < 219;
    const int away = std::min((x - 20 + 240) % 20, 20 - (x + 1 - 20 + 240) % 20);
    const int up = 50;  // between two lines
    const Colour colour = pixel(image, x, size.height - 1 - up);
    if (!inside && (x < 19 || x > 220)) CHECK(colour == kDarkTheme.background);
    if (inside && away > 1 && away < 19) CHECK(colour == kDarkTheme.background);
    if (inside && (x - 20) % 20 == 0) CHECK(difference(colour, kDarkTheme.background) > 50);
  }
}

}  // namespace clatter
