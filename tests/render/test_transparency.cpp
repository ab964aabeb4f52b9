#include <doctest/doctest.h>

#include <cstdint>

#include "tests/render/picture.h"

namespace clatter {

namespace {

// A picture composited over a background by its opacity, as in other programs.
Colour over(Colour picture, Colour background) {
  const auto channel = [&](int c, int b) {
    return static_cast<std::uint8_t>((c * picture.alpha + b * (255 - picture.alpha) + 127) / 255);
  };
  return {channel(picture.red, background.red), channel(picture.green, background.green),
          channel(picture.blue, background.blue)};
}

}  // namespace

TEST_CASE(
    "Transparency: a picture without a background has its own colours, and opacity where something "
    "is") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions = Vec2(5.0, 5.0);
  snapshot.velocities = Vec2(0.0, 0.0);
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  const Camera camera{{5.0, 5.0}, 12.0};
  for (const int samples : {1, 2}) {
    Renderer renderer(context->gl(), samples, true);
    const Image image =
        with_own_colours(draw(renderer, context->gl(), snapshot, camera, {300, 300}, view));
    CHECK(pixel(image, 70, 70).alpha == 0);
    CHECK(pixel(image, 150, 150) == kDarkTheme.disk);
    // The rim of a disk keeps its colour at the edge: no fringe of a background.
    double area = 0.0;
    for (int y = 100; y < 200; ++y) {
      for (int x = 100; x < 200; ++x) {
        const Colour seen = pixel(image, x, y);
        area += seen.alpha / 255.0;
        if (seen.alpha > 32 && seen.alpha < 224) CHECK(seen.red < kDarkTheme.disk.red - 60);
      }
    }
    CHECK(area == doctest::Approx(M_PI * 12.5 * 12.5).epsilon(0.003));
    // Composited, it equals the opaque picture, except for the blending of edges.
    Renderer opaque(context->gl(), samples);
    const Image whole = draw(opaque, context->gl(), snapshot, camera, {300, 300}, view);
    int off = 0;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 300; ++x) {
        off = std::max(
            off, difference(over(pixel(image, x, y), kDarkTheme.background), pixel(whole, x, y)));
      }
    }
    CHECK(off < 30);
  }
}

TEST_CASE(
    "Transparency: small disks, and trails, have their own colours without a background, too") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions = Vec2(5.3, 5.0);
  snapshot.velocities = Vec2(4.0, 0.0);
  snapshot.flights = {{0, -1.0, 0.0, Vec2(1.3, 5.0), Vec2(4.0, 0.0), Vec2(0.0, 0.0)}};
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  // Checks the colours left of `end`, except for faint ones, which have few levels.
  const auto check = [&](Size size, int end, int samples) {
    CAPTURE(samples);
    Renderer renderer(context->gl(), samples, true);
    const Camera camera{{5.0, 5.0}, 9.0};
    const Image image =
        with_own_colours(draw(renderer, context->gl(), snapshot, camera, size, view));
    int seen = 0;
    for (int y = size.height / 4; y < 3 * size.height / 4; ++y) {
      for (int x = 0; x < end; ++x) {
        Colour colour = pixel(image, x, y);
        if (colour.alpha < 48) continue;
        colour.alpha = 255;
        CHECK(difference(colour, kDarkTheme.disk) <= 8);
        ++seen;
      }
    }
    CHECK(seen > 3);
  };
  check({18, 18}, 18, 1);  // a radius of one pixel
  snapshot.exposure = 0.5;
  check({18, 18}, 18, 1);
  snapshot.exposure = 0.0;
  view.trails = 1.0;
  for (const int samples : {1, 2}) check({180, 180}, 80, samples);
}

}  // namespace clatter
