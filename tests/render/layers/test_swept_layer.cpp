#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/layers/disk_layer.h"
#include "render/layers/swept_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

// The path of one disk in consecutive pieces, with an exposure of their whole duration.
Snapshot on_path(double diameter, std::vector<FlightPiece> pieces) {
  Snapshot snapshot = one_disk({0.0, 0.0}, diameter);
  snapshot.exposure = -pieces.front().from;
  snapshot.flights = std::move(pieces);
  return snapshot;
}

Image drawn(const Gl& gl, DiskLayer& layer, const Snapshot& snapshot) {
  const Canvas canvas = blank_canvas(gl, kUnitSize, kClear);
  layer.draw(snapshot, kUnitProjection, {ColourBy::None, {}, kDarkTheme.disk});
  return canvas.read();
}

double alpha(const Image& image, int x, int y) {
  return pixel(image, x, y).alpha / 255.0;
}

double area(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) sum += alpha(image, x, y);
  }
  return sum;
}

// The largest difference, of opacity or of light, from the average over instants of the path.
double off_instants(const Gl& gl, const Snapshot& blurred) {
  constexpr int kInstants = 400;
  DiskLayer layer(gl);
  std::vector<double> sums(4 * kUnitSize.width * kUnitSize.height, 0.0);
  for (int k = 0; k < kInstants; ++k) {
    const double time = blurred.exposure * ((k + 0.5) / kInstants - 1.0);
    Snapshot instant = blurred;
    instant.exposure = 0.0;
    for (const FlightPiece& piece : blurred.flights) {
      if (piece.from <= time && time < piece.to) instant.positions.col(0) = piece.at(time);
    }
    for (const int axis : {0, 1}) {
      double& place = instant.positions(axis, 0);
      if (!instant.walls[2 * axis])
        place -= std::floor(place / instant.box[axis]) * instant.box[axis];
    }
    const Image image = drawn(gl, layer, instant);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += i % 4 == 3 ? image.rgba[i] / 255.0 : linear_light(image.rgba[i]);
    }
  }
  const Image image = drawn(gl, layer, blurred);
  double off = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double seen = i % 4 == 3 ? image.rgba[i] / 255.0 : linear_light(image.rgba[i]);
    off = std::max(off, std::fabs(seen - sums[i] / kInstants));
  }
  return off;
}

}  // namespace

TEST_CASE("Swept layer: a disk at rest looks like a disk at an instant") {
  const auto context = open_context(Backend::Auto);
  DiskLayer layer(context->gl());
  for (const double diameter : {2.0, 3.5, 8.0, 40.0}) {
    CAPTURE(diameter);
    const Vec2 place(71.3, 58.2);
    const Snapshot resting =
        on_path(diameter, {{0, -0.4, -0.1, place, Vec2(0.0, 0.0), Vec2(0.0, 0.0)},
                           {0, -0.1, 0.0, place, Vec2(0.0, 0.0), Vec2(0.0, 0.0)}});
    const Snapshot instant = one_disk(place, diameter);
    CHECK(difference(drawn(context->gl(), layer, resting), drawn(context->gl(), layer, instant)) <=
          (diameter < 3.0 ? 8 : 2));
  }
}

TEST_CASE("Swept layer: a moving disk keeps its area and its light") {
  const auto context = open_context(Backend::Auto);
  DiskLayer layer(context->gl());
  for (const double diameter : {2.0, 6.0, 30.0}) {
    for (const double length : {0.02, 0.5, 3.0, 25.0, 90.0}) {
      for (const double angle : {0.0, 0.4, 2.6, 4.5}) {
        // Fainter streaks have too few of the 255 levels.
        if (length > 10.0 * diameter) continue;
        CAPTURE(diameter);
        CAPTURE(length);
        CAPTURE(angle);
        const Vec2 way = 0.5 * length * Vec2(std::cos(angle), std::sin(angle));
        const Snapshot snapshot =
            on_path(diameter, {{0, -0.5, 0.0, Vec2(100.2, 60.4) - way, 4.0 * way, Vec2(0.0, 0.0)}});
        const double expected = 0.25 * std::numbers::pi * diameter * diameter;
        CHECK(area(drawn(context->gl(), layer, snapshot)) ==
              doctest::Approx(expected).epsilon(0.01));
      }
    }
  }
}

TEST_CASE(
    "Swept layer: at constant speed the opacity is the share of time in which a pixel is covered") {
  const auto context = open_context(Backend::Auto);
  DiskLayer layer(context->gl());
  constexpr double kLength = 80.0, kRadius = 15.0;
  const Vec2 start(60.0, 60.0);
  const Image image =
      drawn(context->gl(), layer,
            on_path(2.0 * kRadius, {{0, -2.0, 0.0, start, Vec2(40.0, 0.0), Vec2(0.0, 0.0)}}));
  for (int y = 48; y <= 72; y += 3) {
    for (int x = 44; x < 156; ++x) {
      const Vec2 place = Vec2(x + 0.5, kUnitSize.height - y - 0.5) - start;
      const double half = std::sqrt(kRadius * kRadius - place.y() * place.y());
      const double covered = std::min(place.x() + half, kLength) - std::max(place.x() - half, 0.0);
      CHECK(std::fabs(alpha(image, x, y) - std::max(0.0, covered) / kLength) < 0.008);
    }
  }
}

TEST_CASE("Swept layer: paths with collisions and borders look like the average of instants") {
  const auto context = open_context(Backend::Auto);
  for (const double diameter : {2.0, 5.0, 30.0}) {
    CAPTURE(diameter);
    // Reflected off a wall with a gain, then on a parabola.
    const Snapshot bounce = on_path(
        diameter, {{0, -1.0, -0.6, Vec2(150.0, 50.0), Vec2(80.0, 20.0), Vec2(0.0, 0.0)},
                   {0, -0.6, 0.0, Vec2(182.0, 58.0), Vec2(-120.0, 90.0), Vec2(0.0, -300.0)}});
    CHECK(off_instants(context->gl(), bounce) < 0.012);
    // Through a periodic box repeatedly.
    Snapshot fast =
        on_path(diameter, {{0, -1.0, 0.0, Vec2(20.0, 30.0), Vec2(530.0, -410.0), Vec2(0.0, 0.0)}});
    fast.walls = {};
    CHECK(off_instants(context->gl(), fast) < 0.03);  // the instants are some pixels apart
    // Across a periodic border, also in steps of less than a pixel.
    for (const double speed : {30.0, 1.0}) {
      Snapshot crossing = on_path(
          diameter, {{0, -1.0, 0.0, Vec2(199.0, 119.2), Vec2(speed, 0.5 * speed), Vec2(0.0, 0.0)}});
      crossing.walls = {};
      CHECK(off_instants(context->gl(), crossing) < 0.012);
    }
  }
}

}  // namespace clatter
