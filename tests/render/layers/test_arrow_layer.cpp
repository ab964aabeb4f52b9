#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "render/layers/arrow_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Colour kInk = {0xff, 0xff, 0xff};
constexpr Size kArrowSize{200, 200};

Image draw(const Gl& gl, const std::vector<ArrowMap::Arrow>& arrows, double pixels) {
  const Canvas canvas = blank_canvas(gl, kArrowSize);
  const ArrowMap map{Quantity::Velocity, Vec2(4.0, 4.0), arrows};
  // 10 pixels a unit.
  ArrowLayer(gl).draw(map, {{Vec2(10.0, 10.0), 20.0}, kArrowSize}, pixels, kInk,
                      kDarkTheme.background);
  return canvas.read();
}

// The extent of the pixels close to the ink's colour.
struct Extent {
  Vec2 low = {1e9, 1e9}, high = {-1e9, -1e9};
  Vec2 mean = {0.0, 0.0};
  int count = 0;
};

Extent extent_of(const Image& image) {
  Extent extent;
  for (int y = 0; y < kArrowSize.height; ++y) {
    for (int x = 0; x < kArrowSize.width; ++x) {
      if (difference(pixel(image, x, y), kInk) > 100) continue;
      const Vec2 place(x + 0.5, kArrowSize.height - y - 0.5);
      extent.low = extent.low.cwiseMin(place);
      extent.high = extent.high.cwiseMax(place);
      extent.mean += place;
      ++extent.count;
    }
  }
  extent.mean /= std::max(1, extent.count);
  return extent;
}

}  // namespace

TEST_CASE(
    "Arrow layer: an arrow is as long as its value, points along it, and has its middle at its "
    "place") {
  const auto context = open_context(Backend::Auto);
  for (int k = 0; k < 12; ++k) {
    CAPTURE(k);
    const double angle = k * std::numbers::pi / 6.0;
    const Vec2 along(std::cos(angle), std::sin(angle));
    const Image image = draw(context->gl(), {{Vec2(8.0, 11.0), 3.0 * along}}, 20.0);
    const Extent extent = extent_of(image);
    const Vec2 middle(80.0, 110.0);
    REQUIRE(extent.count > 80);
    // The box around a line of 60 pixels. The head, the shaft and antialiased ends add a few
    // pixels.
    for (int axis : {0, 1}) {
      const double half = 30.0 * std::abs(along[axis]);
      CHECK(std::abs(extent.low[axis] - (middle[axis] - half)) < 4.5);
      CHECK(std::abs(extent.high[axis] - (middle[axis] + half)) < 4.5);
    }
    // The head has more pixels than the tail.
    CHECK((extent.mean - middle).dot(along) > 1.0);
  }
}

TEST_CASE("Arrow layer: arrows are two cells long at most, and vanishing values have none") {
  const auto context = open_context(Backend::Auto);
  const Extent extent = extent_of(draw(context->gl(), {{Vec2(10.0, 10.0), Vec2(1e6, 0.0)}}, 20.0));
  CHECK(std::abs(extent.high.x() - extent.low.x() - 80.0) < 4.0);
  CHECK(extent_of(draw(context->gl(), {{Vec2(10.0, 10.0), Vec2(0.0, 0.0)}}, 20.0)).count == 0);
}

TEST_CASE("Arrow layer: a short arrow keeps its form") {
  const auto context = open_context(Backend::Auto);
  const Extent small = extent_of(draw(context->gl(), {{Vec2(10.05, 10.05), Vec2(0.2, 0.0)}}, 20.0));
  REQUIRE(small.count > 0);
  CHECK(small.high.x() - small.low.x() <= 4.0);
  CHECK(small.high.y() - small.low.y() <= 3.0);
}

// A flux of rounding errors would give a field of bars. Coincident tips have no direction.
TEST_CASE("Arrow layer: arrows shorter than half a pixel are not drawn") {
  const auto context = open_context(Backend::Auto);
  for (const double length : {0.024, 1e-7, 1e-20, 5e-324}) {  // .024: .48 pixels
    CAPTURE(length);
    const std::vector<ArrowMap::Arrow> arrows = {{Vec2(10.0, 10.0), Vec2(length, 0.0)},
                                                 {Vec2(4.0, 5.0), Vec2(0.0, -length)}};
    const Image image = draw(context->gl(), arrows, 20.0);
    CHECK(difference(image, draw(context->gl(), {}, 20.0)) == 0);
  }
  const Image shown = draw(context->gl(), {{Vec2(10.0, 10.0), Vec2(0.026, 0.0)}}, 20.0);
  CHECK(difference(shown, draw(context->gl(), {}, 20.0)) > 0);
  // NaN has no direction either.
  const double nan = std::nan("");
  const Image none = draw(context->gl(), {{Vec2(10.0, 10.0), Vec2(nan, 1.0)}}, 20.0);
  CHECK(difference(none, draw(context->gl(), {}, 20.0)) == 0);
}

}  // namespace clatter
