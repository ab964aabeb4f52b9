#include "render/layers/wall_layer.h"

#include <doctest/doctest.h>

#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kSize{200, 200};

// A box of 10 x 10 in the middle of the picture, 100 pixels wide.
Image draw(const Gl& gl, const Wall& wall, double time = 0.0) {
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.time = time;
  snapshot.temperature = 1.0;
  snapshot.walls[kLeft] = snapshot.walls[kRight] = wall;
  const Canvas canvas = blank_canvas(gl, kSize);
  WallLayer(gl).draw(snapshot, {{{5.0, 5.0}, 20.0}, kSize});
  return canvas.read();
}

Wall wall_of(WallKind kind) {
  Wall wall;
  wall.kind = kind;
  wall.drive_speed = 1.0;
  return wall;
}

}  // namespace

TEST_CASE("A wall begins at the edge of the box and leaves the inside alone") {
  const auto context = open_context(Backend::Osmesa);
  for (WallKind kind : {WallKind::Static, WallKind::Driven, WallKind::Thermal}) {
    const Image image = draw(context->gl(), wall_of(kind));
    CHECK(difference(pixel(image, 49, 100), theme::kBackground) > 50);
    CHECK(difference(pixel(image, 150, 100), theme::kBackground) > 50);
    for (int y = 53; y < 147; ++y) {
      for (int x = 50; x < 150; ++x) REQUIRE(pixel(image, x, y) == theme::kBackground);
    }
  }
}

TEST_CASE("Only a driven wall moves, at the speed it stands for") {
  const auto context = open_context(Backend::Osmesa);
  const Image start = draw(context->gl(), wall_of(WallKind::Driven));
  CHECK(difference(start, draw(context->gl(), wall_of(WallKind::Driven), 0.3)) > 50);
  // The teeth repeat every 0.75 thicknesses: half the drive speed carries them there in this time.
  const double period = 2.0 * 0.75 * wall_thickness(kSize) / 10.0;
  CHECK(difference(start, draw(context->gl(), wall_of(WallKind::Driven), period)) <= 4);
  for (WallKind kind : {WallKind::Static, WallKind::Thermal}) {
    CHECK(difference(draw(context->gl(), wall_of(kind)), draw(context->gl(), wall_of(kind), 0.3)) ==
          0);
  }
}

TEST_CASE("A driven wall is warm, and a hot thermal one brighter than a cold one") {
  const auto context = open_context(Backend::Osmesa);
  const Colour driven = pixel(draw(context->gl(), wall_of(WallKind::Driven)), 49, 100);
  CHECK(driven.red > 2 * driven.blue);
  Wall thermal = wall_of(WallKind::Thermal);
  thermal.temperature = 0.1;
  const Colour cold = pixel(draw(context->gl(), thermal), 49, 100);
  thermal.temperature = 10.0;
  const Colour hot = pixel(draw(context->gl(), thermal), 49, 100);
  CHECK(hot.red + hot.green + hot.blue > cold.red + cold.green + cold.blue + 100);
}

TEST_CASE("A periodic border is a dashed line") {
  const auto context = open_context(Backend::Osmesa);
  const Image image = draw(context->gl(), Wall{});
  int drawn = 0;
  for (int x = 50; x < 150; ++x) {
    const Colour a = pixel(image, x, 49), b = pixel(image, x, 50);
    if (difference(a, theme::kBackground) + difference(b, theme::kBackground) > 30) ++drawn;
  }
  CHECK(drawn > 30);
  CHECK(drawn < 70);
}

}  // namespace clatter
