#include <doctest/doctest.h>

#include <cmath>

#include "render/layers/trail_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

Image drawn(const Gl& gl, const Snapshot& snapshot, double time) {
  const Canvas canvas = blank_canvas(gl, kUnitSize, kClear);
  TrailLayer(gl).draw(snapshot, snapshot.flights, kUnitProjection,
                      {ColourBy::None, {}, kDarkTheme.disk}, time);
  return canvas.read();
}

}  // namespace

TEST_CASE("Trail layer: trails follow the paths and fade out to their ends") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({120.0, 100.0}, 20.0);
  snapshot.velocities = Vec2(0.0, 40.0);
  // Along x, then up.
  snapshot.flights = {{0, -3.0, -1.0, Vec2(40.0, 60.0), Vec2(40.0, 0.0), Vec2(0.0, 0.0)},
                      {0, -1.0, 0.0, Vec2(120.0, 60.0), Vec2(0.0, 40.0), Vec2(0.0, 0.0)}};
  const Image image = drawn(context->gl(), snapshot, 2.0);
  const auto opacity = [&](int x, int up) {
    return pixel(image, x, kUnitSize.height - 1 - up).alpha / 255.0;
  };
  for (int up = 62; up < 100; up += 7) {
    CHECK(opacity(120, up) == doctest::Approx(0.6 * (1.0 - (100 - up) / 80.0)).epsilon(0.03));
  }
  for (int x = 90; x < 118; x += 7) {
    CHECK(std::fabs(opacity(x, 60) - 0.6 * (0.5 - (120 - x) / 80.0)) < 0.01);
  }
  // The joint is no brighter than its two pieces.
  for (int x = 117; x <= 123; ++x) {
    for (int up = 57; up <= 61; ++up) CHECK(opacity(x, up) < 0.6 * 0.53);
  }
  CHECK(opacity(70, 60) == 0.0);    // too long ago
  CHECK(opacity(120, 106) == 0.0);  // not reached yet
  CHECK(opacity(128, 80) == 0.0);
}

}  // namespace clatter
