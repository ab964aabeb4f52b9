#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "render/tiling.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

/// A picture with one pixel per world unit, from (-40, -10).
constexpr double kLength = 64.0, kHeight = 100.0;
const Projection kTiled{{{60.0, 50.0}, 200.0}, kUnitSize};

Colour at(const Image& image, double x, double y) {
  return pixel(image, static_cast<int>(x + 40.0),
               kUnitSize.height - 1 - static_cast<int>(y + 10.0));
}

/// Three disks in a box that is periodic along x. One of them crosses the edge.
Snapshot channel(double diameter) {
  Snapshot snapshot;
  snapshot.box = Vec2(kLength, kHeight);
  snapshot.diameter = diameter;
  snapshot.walls[kBottom] = snapshot.walls[kTop] = Wall{};
  snapshot.positions = as_columns<2>({{20.3, 60.0}, {62.0, 85.2}, {40.0, 25.0}});
  snapshot.velocities = as_columns<2>({{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}});
  snapshot.flights = {{0, -1.0, 0.0, Vec2(-10.0, 40.0), Vec2(30.3, 20.0), Vec2(0.0, 0.0)},
                      {1, -1.0, 0.0, Vec2(62.0, 75.2), Vec2(0.0, 10.0), Vec2(0.0, 0.0)},
                      {2, -1.0, 0.0, Vec2(40.0 + 64.0, 15.0), Vec2(-64.0, 10.0), Vec2(0.0, 0.0)}};
  snapshot.field = FieldMap{Quantity::Density, {4, 2}, {0.1, 0.9, 0.5, 0.7, 1.0, 0.3, 0.8, 0.2}};
  return snapshot;
}

View tiled_view() {
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  view.tiling = true;
  return view;
}

Image drawn_tiles(const Snapshot& snapshot, const View& view, bool transparent = false) {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), 1, transparent);
  return draw(renderer, context->gl(), snapshot, kTiled.camera, kUnitSize, view);
}

/// The mean of two stored colours, or of their light.
Colour mean_stored(Colour a, Colour b) {
  const auto mean = [](int c, int d) { return static_cast<std::uint8_t>((c + d + 1) / 2); };
  return {mean(a.red, b.red), mean(a.green, b.green), mean(a.blue, b.blue)};
}
Colour mean_light_of(Colour a, Colour b) {
  const auto mean = [](std::uint8_t c, std::uint8_t d) {
    const double light = 0.5 * (linear_light(c) + linear_light(d));
    return static_cast<std::uint8_t>(
        std::lround(255.0 * (1.055 * std::pow(light, 1.0 / 2.4) - 0.055)));
  };
  return {mean(a.red, b.red), mean(a.green, b.green), mean(a.blue, b.blue)};
}

}  // namespace

TEST_CASE("Tiling: a copy has the colours of the box, at half their opacity") {
  View view = tiled_view();
  view.field = Quantity::Density;
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  for (const FieldStyle style : {FieldStyle::Cells, FieldStyle::Smooth}) {
    view.field_style = style;
    Snapshot snapshot = channel(20.0);
    const Image image = drawn_tiles(snapshot, view);
    snapshot.positions.conservativeResize(2, 0);
    snapshot.velocities.conservativeResize(2, 0);
    View untiled = view;
    untiled.tiling = false;
    const Image field = drawn_tiles(snapshot, untiled);
    int fields = 0, disks = 0;
    for (double y = 1.5; y < kHeight - 1.0; ++y) {
      for (double x = 2.5; x < kLength - 2.0; ++x) {
        const Colour here = at(image, x, y), ground = at(field, x, y);
        const Colour faint = mean_stored(ground, kDarkTheme.background);
        for (const int copy : {-1, 1, 2}) {
          const double there = x + copy * kLength;
          if (there < -39.0 || there > 159.0) continue;
          if (here == ground) {
            ++fields;
            REQUIRE(difference(at(image, there, y), faint) <= 1);
          } else if (here == kDarkTheme.disk) {
            ++disks;
            REQUIRE(difference(at(image, there, y), mean_light_of(here, faint)) <= 1);
          }
        }
      }
    }
    CHECK(fields > 5000);
    CHECK(disks > 500);
    // No copies beyond walls.
    CHECK(at(image, 90.0, -8.0) == kDarkTheme.background);
    CHECK(at(image, 90.0, 108.0) == kDarkTheme.background);
  }
}

TEST_CASE("Tiling: the box itself stays as it is, and copies have half of its light") {
  // Particles with and without a shape, at rest, blurred, and with trails.
  for (const double diameter : {20.0, 2.0}) {
    for (const double exposure : {0.0, 1.0}) {
      for (const bool trails : {false, true}) {
        CAPTURE(diameter);
        CAPTURE(exposure);
        CAPTURE(trails);
        Snapshot snapshot = channel(diameter);
        snapshot.exposure = exposure;
        View view = tiled_view();
        if (trails) view.trails = 0.8;
        const Image tiled = drawn_tiles(snapshot, view, true);
        view.tiling = false;
        const Image alone = drawn_tiles(snapshot, view, true);
        std::array<double, 3> sums{};
        for (double y = 0.5; y < kHeight; ++y) {
          for (double x = 1.5; x < kLength - 1.0; ++x) {
            REQUIRE(at(tiled, x, y) == at(alone, x, y));
            for (const int copy : {0, 1}) sums[copy] += at(tiled, x + copy * kLength, y).alpha;
          }
        }
        CHECK(sums[0] > 1000.0);
        // A trail below a disk shines through its copy.
        CHECK(sums[1] / sums[0] == doctest::Approx(0.5).epsilon(trails ? 0.06 : 0.01));
      }
    }
  }
}

TEST_CASE("Tiling: a box with two periodic axes has copies at its corners") {
  Snapshot snapshot = one_disk({20.0, 30.0}, 20.0);
  snapshot.box = Vec2(50.0, 40.0);
  snapshot.walls.fill({});
  const Image image = drawn_tiles(snapshot, tiled_view());
  const Colour faint = mean_light_of(kDarkTheme.disk, kDarkTheme.background);
  for (const double x : {-30.0, 20.0, 70.0, 120.0}) {
    for (const double y : {-9.0, 30.0, 70.0, 109.0}) {
      const bool own = x == 20.0 && y == 30.0;
      CHECK(difference(at(image, x, y), own ? kDarkTheme.disk : faint) <= 1);
    }
  }
}

TEST_CASE("Tiling: texts over copies have a plate") {
  View view = tiled_view();
  view.field = Quantity::Density;
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  Snapshot snapshot = channel(1.0);
  snapshot.walls = {Wall{}, Wall{}};
  snapshot.field = FieldMap{Quantity::Density, {1, 1}, {1.0}};
  constexpr Size kSize{400, 300};
  const Camera camera{{32.0, 50.0}, 400.0};  // the box is from column 168 to 232
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const auto heading = [&](const Snapshot& gas) {
    view.overlay = true;
    return pixel(draw(renderer, context->gl(), gas, camera, kSize, view), 11, 20);
  };
  CHECK(heading(snapshot) == kDarkTheme.background);
  snapshot.walls = {};
  view.overlay = false;
  const Colour copy = pixel(draw(renderer, context->gl(), snapshot, camera, kSize, view), 11, 20);
  CHECK(difference(copy, kDarkTheme.background) > 20);
  const double share = 1.0 * difference(heading(snapshot), kDarkTheme.background) /
                       difference(copy, kDarkTheme.background);
  CHECK(std::fabs(share - 0.2) < 0.06);
}

TEST_CASE("Tiling: the number of copies is bounded") {
  Snapshot snapshot = channel(1.0);
  snapshot.walls = {};
  View view = tiled_view();
  const auto copies = [&](double width) {
    return tiling_of(snapshot, {{{32.0, 50.0}, width}, {400, 400}}, view);
  };
  using Ends = std::array<int, 2>;
  CHECK(copies(20.0).first == Ends{0, 0});
  CHECK(copies(20.0).last == Ends{0, 0});
  // From -68 to 132, and from -50 to 150: lengths 64 and 100.
  CHECK(copies(200.0).first == Ends{-2, -1});
  CHECK(copies(200.0).last == Ends{2, 1});
  CHECK(copies(1e9).first == Ends{-8, -8});
  CHECK(copies(1e9).last == Ends{8, 8});
  // 11 x 11 boxes of 30000 disks are 3.63 million, 13 x 13 are 5.07 million.
  snapshot.positions.resize(2, 30000);
  CHECK(copies(1e9).last == Ends{5, 5});
  snapshot.positions.resize(2, 1000000);
  CHECK(copies(1e9).last == Ends{1, 1});
  snapshot.walls[kLeft] = snapshot.walls[kRight] = Wall{};
  CHECK(copies(1e9).first == Ends{0, -1});
  view.tiling = false;
  CHECK(copies(1e9).last == Ends{0, 0});
}

}  // namespace clatter
