#include <doctest/doctest.h>

#include "render/camera.h"

namespace clatter {

TEST_CASE("Camera: a fitted camera puts the box between the margins, as large as they allow") {
  const Size size{1280, 720};
  const Margins margins{100, 40, 80, 20};
  const Camera camera = Camera::fit({-1, 0}, {19, 25}, size, margins);
  const Projection projection{camera, size};
  const Vec2 low = projection.pixels({-1, 0}), high = projection.pixels({19, 25});
  CHECK(low.y() == doctest::Approx(20));
  CHECK(high.y() == doctest::Approx(720 - 80));
  CHECK(low.x() - 100 == doctest::Approx(1280 - 40 - high.x()));
  CHECK((high - low).x() / 20 == doctest::Approx((high - low).y() / 25));
}

TEST_CASE("Camera: pixels stay exact far from the origin") {
  const Projection projection{{{1e9, -1e9}, 64.0}, {640, 480}};
  const Vec2 pixel = projection.pixels({1e9 + 1.0, -1e9 + 2.0});
  CHECK(pixel.x() == doctest::Approx(330).epsilon(1e-9));
  CHECK(pixel.y() == doctest::Approx(260).epsilon(1e-9));
}

}  // namespace clatter
