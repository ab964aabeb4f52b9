#include <doctest/doctest.h>

#include "render/layers/wall_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kWallSize{200, 200};

// A box of 10 x 10 in the middle of the picture, 100 pixels wide.
Image draw(const Gl& gl, const Wall& wall, double time = 0.0) {
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.time = time;
  snapshot.temperature = 1.0;
  snapshot.walls[kLeft] = snapshot.walls[kRight] = wall;
  const Canvas canvas = blank_canvas(gl, kWallSize);
  WallLayer(gl).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
  return canvas.read();
}

Wall wall_of(WallKind kind) {
  Wall wall;
  wall.kind = kind;
  wall.drive_speed = 1.0;
  return wall;
}

}  // namespace

TEST_CASE("Wall layer: a wall begins at the edge of the box and leaves the inside alone") {
  const auto context = open_context(Backend::Auto);
  for (WallKind kind : {WallKind::Static, WallKind::Driven, WallKind::Thermal}) {
    const Image image = draw(context->gl(), wall_of(kind));
    CHECK(difference(pixel(image, 49, 100), kDarkTheme.background) > 50);
    CHECK(difference(pixel(image, 150, 100), kDarkTheme.background) > 50);
    for (int y = 53; y < 147; ++y) {
      for (int x = 50; x < 150; ++x) REQUIRE(pixel(image, x, y) == kDarkTheme.background);
    }
  }
}

TEST_CASE("Wall layer: only a driven wall's teeth move, at half its drive speed") {
  const auto context = open_context(Backend::Auto);
  const Image start = draw(context->gl(), wall_of(WallKind::Driven));
  CHECK(difference(start, draw(context->gl(), wall_of(WallKind::Driven), 0.3)) > 50);
  // The teeth repeat every 0.75 thicknesses. At half the drive speed they move by this distance in
  // this time.
  const double period = 2.0 * 0.75 * wall_thickness(kWallSize) / 10.0;
  CHECK(difference(start, draw(context->gl(), wall_of(WallKind::Driven), period)) <= 4);
  for (WallKind kind : {WallKind::Static, WallKind::Thermal}) {
    CHECK(difference(draw(context->gl(), wall_of(kind)), draw(context->gl(), wall_of(kind), 0.3)) ==
          0);
  }
}

TEST_CASE("Wall layer: a moving wall is drawn at its position, and covers the picture behind it") {
  const auto context = open_context(Backend::Auto);
  for (WallKind kind : {WallKind::Sawtooth, WallKind::Sinusoidal}) {
    for (double displacement : {-1.0, 0.0, 2.0, 3.0}) {  // 10 pixels each
      CAPTURE(displacement);
      Snapshot snapshot;
      snapshot.box = Vec2(10.0, 10.0);
      snapshot.walls[kLeft] = snapshot.walls[kRight] = wall_of(kind);
      snapshot.wall_displacement[kLeft] = displacement;
      const Canvas canvas = blank_canvas(context->gl(), kWallSize);
      // A field, brighter than any wall.
      context->gl().ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
      context->gl().Clear(GL_COLOR_BUFFER_BIT);
      WallLayer(context->gl()).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
      const Image image = canvas.read();
      const Colour white = {255, 255, 255};
      const int face = 50 + static_cast<int>(10.0 * displacement);
      for (int y : {60, 100, 140}) {
        for (int x = std::max(face, 52); x < 150; ++x) REQUIRE(pixel(image, x, y) == white);
        const Colour at_face = pixel(image, face - 1, y);
        CHECK(at_face.red > 2 * at_face.blue);
        for (int x = 52; x < face; ++x) CHECK(difference(pixel(image, x, y), white) > 100);
        // The other wall is unchanged.
        CHECK(pixel(image, 150, y).red > 2 * pixel(image, 150, y).blue);
      }
    }
  }
}

TEST_CASE(
    "Wall layer: a piston of any kind is drawn at its position, and covers the field behind") {
  const auto context = open_context(Backend::Auto);
  for (WallKind kind : {WallKind::Static, WallKind::Driven, WallKind::Thermal}) {
    Snapshot snapshot;
    snapshot.box = Vec2(10.0, 10.0);
    snapshot.walls[kLeft] = snapshot.walls[kRight] = wall_of(kind);
    snapshot.wall_displacement[kRight] = 4.0;
    const Canvas canvas = blank_canvas(context->gl(), kWallSize);
    context->gl().ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
    context->gl().Clear(GL_COLOR_BUFFER_BIT);
    WallLayer(context->gl()).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
    const Image image = canvas.read();
    const Colour white = {255, 255, 255};
    for (int y : {60, 100, 140}) {
      for (int x = 52; x < 110; ++x) REQUIRE(pixel(image, x, y) == white);
      for (int x = 110; x < 149; ++x) CHECK(difference(pixel(image, x, y), white) > 50);
    }
  }
}

TEST_CASE("Wall layer: a moving wall looks the same wherever it is") {
  const auto context = open_context(Backend::Auto);
  const auto at = [&](double displacement) {
    Snapshot snapshot;
    snapshot.box = Vec2(10.0, 10.0);
    snapshot.time = displacement;
    snapshot.walls[kLeft] = snapshot.walls[kRight] = wall_of(WallKind::Sawtooth);
    snapshot.wall_displacement[kLeft] = displacement;
    const Canvas canvas = blank_canvas(context->gl(), kWallSize);
    WallLayer(context->gl()).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
    return canvas.read();
  };
  const Image start = at(0.0), moved = at(3.0);
  const int thickness = static_cast<int>(wall_thickness(kWallSize));
  for (int y = 55; y < 145; ++y) {
    for (int x = 50 - thickness; x < 49; ++x) {
      CHECK(difference(pixel(start, x, y), pixel(moved, x + 30, y)) <= 3);
    }
  }
}

TEST_CASE(
    "Wall layer: a line marks the place of a wall that has moved, as long as the box is wide") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.walls.fill(wall_of(WallKind::Static));
  snapshot.walls[kLeft] = wall_of(WallKind::Sinusoidal);
  for (double displacement : {-2.0, 2.0}) {
    CAPTURE(displacement);
    snapshot.wall_displacement[kLeft] = displacement;
    const Canvas canvas = blank_canvas(context->gl(), kWallSize);
    WallLayer(context->gl()).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
    const Image image = canvas.read();
    for (int y = 51; y < 149; ++y) {
      CHECK(difference(pixel(image, 49, y), kDarkTheme.background) > 20);
    }
    for (int y : {35, 165}) CHECK(pixel(image, 49, y) == kDarkTheme.background);
  }
}

TEST_CASE("Wall layer: the walls beside one that moves end at its face") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.walls.fill(wall_of(WallKind::Thermal));
  snapshot.walls[kLeft] = wall_of(WallKind::Sinusoidal);
  for (double displacement : {-1.0, 2.0}) {
    snapshot.wall_displacement[kLeft] = displacement;
    const Canvas canvas = blank_canvas(context->gl(), kWallSize);
    WallLayer(context->gl()).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
    const Image image = canvas.read();
    const int face = 50 + static_cast<int>(10.0 * displacement);
    CHECK(difference(pixel(image, face + 2, 150), kDarkTheme.background) > 30);
    CHECK(difference(pixel(image, face - 8, 150), kDarkTheme.background) < 30);
  }
}

TEST_CASE("Wall layer: a driven wall is warm") {
  const auto context = open_context(Backend::Auto);
  const Colour driven = pixel(draw(context->gl(), wall_of(WallKind::Driven)), 49, 100);
  CHECK(driven.red > 2 * driven.blue);
}

TEST_CASE("Wall layer: a periodic border is a dashed line") {
  const auto context = open_context(Backend::Auto);
  const Image image = draw(context->gl(), Wall{});
  int drawn = 0;
  for (int x = 50; x < 150; ++x) {
    const Colour a = pixel(image, x, 49), b = pixel(image, x, 50);
    if (difference(a, kDarkTheme.background) + difference(b, kDarkTheme.background) > 30) ++drawn;
  }
  CHECK(drawn > 30);
  CHECK(drawn < 70);
}

}  // namespace clatter
