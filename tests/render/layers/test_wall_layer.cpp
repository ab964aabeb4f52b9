#include <doctest/doctest.h>

#include "render/layers/wall_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kWallSize{200, 200};

// A picture of a box of 10 x 10 in its middle, 100 pixels wide.
Image draw(const Gl& gl, const Snapshot& snapshot, Colour ground = kDarkTheme.background) {
  const Canvas canvas = blank_canvas(gl, kWallSize, ground);
  WallLayer(gl).draw(snapshot, {{{5.0, 5.0}, 20.0}, kWallSize}, {kDarkTheme});
  return canvas.read();
}

Snapshot box_between(const Wall& wall) {
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.temperature = 1.0;
  snapshot.walls[kLeft] = snapshot.walls[kRight] = wall;
  return snapshot;
}

Image draw(const Gl& gl, const Wall& wall, double time = 0.0) {
  Snapshot snapshot = box_between(wall);
  snapshot.time = time;
  return draw(gl, snapshot);
}

constexpr Colour kWhite{255, 255, 255};  // of a field, brighter than any wall

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
      Snapshot snapshot = box_between(wall_of(kind));
      snapshot.wall_displacement[kLeft] = displacement;
      const Image image = draw(context->gl(), snapshot, kWhite);
      const int face = 50 + static_cast<int>(10.0 * displacement);
      for (int y : {60, 100, 140}) {
        for (int x = std::max(face, 52); x < 150; ++x) REQUIRE(pixel(image, x, y) == kWhite);
        const Colour at_face = pixel(image, face - 1, y);
        CHECK(at_face.red > 2 * at_face.blue);
        for (int x = 52; x < face; ++x) CHECK(difference(pixel(image, x, y), kWhite) > 100);
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
    Snapshot snapshot = box_between(wall_of(kind));
    snapshot.wall_displacement[kRight] = 4.0;
    const Image image = draw(context->gl(), snapshot, kWhite);
    for (int y : {60, 100, 140}) {
      for (int x = 52; x < 110; ++x) REQUIRE(pixel(image, x, y) == kWhite);
      for (int x = 110; x < 149; ++x) CHECK(difference(pixel(image, x, y), kWhite) > 50);
    }
  }
}

TEST_CASE("Wall layer: a moving wall looks the same wherever it is") {
  const auto context = open_context(Backend::Auto);
  const auto at = [&](double displacement) {
    Snapshot snapshot = box_between(wall_of(WallKind::Sawtooth));
    snapshot.time = displacement;
    snapshot.wall_displacement[kLeft] = displacement;
    return draw(context->gl(), snapshot);
  };
  const Image start = at(0.0), moved = at(3.0);
  const int thickness = static_cast<int>(wall_thickness(kWallSize));
  for (int y = 55; y < 145; ++y) {
    for (int x = 50 - thickness; x < 49; ++x) {
      CHECK(difference(pixel(start, x, y), pixel(moved, x + 30, y)) <= 3);
    }
  }
}

}  // namespace clatter
