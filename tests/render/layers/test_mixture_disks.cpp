// Disks of different sizes in one picture.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "render/layers/disk_layer.h"
#include "render/layers/trail_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

struct PlacedDisk {
  Vec2 centre;
  double radius;
};

// Disks at rest in a walled box, in a picture with one pixel per world unit. Disk k has species k.
Snapshot unequal_disks(const std::vector<PlacedDisk>& disks) {
  Snapshot snapshot = one_disk({0.0, 0.0}, 1.0);
  std::vector<Vec2> places;
  snapshot.diameter = 0.0;
  for (const auto& [centre, radius] : disks) {
    snapshot.diameter = std::max(snapshot.diameter, 2.0 * radius);
    snapshot.grains.push_back(
        {.radius = radius, .species = static_cast<std::uint32_t>(places.size())});
    places.push_back(centre);
  }
  snapshot.positions = as_columns(places);
  snapshot.velocities = Vectors::Zero(2, snapshot.positions.cols());
  return snapshot;
}

Image drawn_disks(const Gl& gl, const Snapshot& snapshot,
                  std::optional<double> largest_point = {}) {
  const Canvas canvas = blank_canvas(gl, kUnitSize, kClear);
  DiskLayer(gl, largest_point)
      .draw(snapshot, kUnitProjection, {ColourBy::None, {}, kDarkTheme.disk});
  return canvas.read();
}

// The covered area of the columns from `begin` to `end`.
double covered(const Image& image, int begin = 0, int end = kUnitSize.width) {
  double sum = 0.0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = begin; x < end; ++x) sum += pixel(image, x, y).alpha / 255.0;
  }
  return sum;
}

double disk_area(double radius) {
  return std::numbers::pi * radius * radius;
}

}  // namespace

TEST_CASE("Mixture disks: each covers the area of its own radius, as a point or as a square") {
  const auto context = open_context(Backend::Auto);
  const Snapshot snapshot = unequal_disks({{{50.3, 60.2}, 30.0}, {{130.6, 55.1}, 9.0}});
  for (const double largest_point : {1e9, 0.0}) {
    const Image image = drawn_disks(context->gl(), snapshot, largest_point);
    CHECK(covered(image, 0, 100) == doctest::Approx(disk_area(30.0)).epsilon(0.01));
    CHECK(covered(image, 100) == doctest::Approx(disk_area(9.0)).epsilon(0.01));
    // At the edges along the row through each centre.
    for (const auto& [x, radius] : {std::pair(50.3, 30.0), {130.6, 9.0}}) {
      const int row = kUnitSize.height - 1 - (x < 100.0 ? 60 : 55);
      CHECK(pixel(image, static_cast<int>(x + radius - 2.0), row).alpha == 255);
      CHECK(pixel(image, static_cast<int>(x + radius + 2.0), row).alpha == 0);
    }
  }
}

TEST_CASE("Mixture disks: those without a shape have their area beside large ones") {
  const auto context = open_context(Backend::Auto);
  const Snapshot snapshot =
      unequal_disks({{{50.3, 60.2}, 30.0}, {{120.6, 55.1}, 1.4}, {{160.2, 70.9}, 0.7}});
  const Image image = drawn_disks(context->gl(), snapshot);
  CHECK(covered(image, 0, 100) == doctest::Approx(disk_area(30.0)).epsilon(0.01));
  CHECK(covered(image, 100, 140) == doctest::Approx(disk_area(1.4)).epsilon(0.02));
  CHECK(covered(image, 140) == doctest::Approx(disk_area(0.7)).epsilon(0.02));
}

TEST_CASE("Mixture disks: a picture of small disks alone has the area of each") {
  const auto context = open_context(Backend::Auto);
  const Snapshot snapshot = unequal_disks({{{50.3, 60.2}, 1.45}, {{120.6, 55.1}, 0.5}});
  const Image image = drawn_disks(context->gl(), snapshot);
  CHECK(covered(image, 0, 100) == doctest::Approx(disk_area(1.45)).epsilon(0.02));
  CHECK(covered(image, 100) == doctest::Approx(disk_area(0.5)).epsilon(0.02));
}

TEST_CASE("Mixture disks: one that crosses a periodic border is on both sides") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = unequal_disks({{{12.0, 60.0}, 20.0}, {{12.0, 100.0}, 5.0}});
  snapshot.walls[kLeft].reset();
  snapshot.walls[kRight].reset();
  const Image image = drawn_disks(context->gl(), snapshot);
  CHECK(pixel(image, 196, kUnitSize.height - 61).alpha == 255);
  CHECK(covered(image) == doctest::Approx(disk_area(20.0) + disk_area(5.0)).epsilon(0.01));
  for (int x = 150; x < 200; ++x) CHECK(pixel(image, x, kUnitSize.height - 101).alpha == 0);
}

TEST_CASE("Mixture disks: with an exposure each keeps its area along its way") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot =
      unequal_disks({{{50.0, 80.0}, 20.0}, {{150.0, 80.0}, 6.0}, {{150.0, 30.0}, 1.2}});
  snapshot.exposure = 0.5;
  const Vec2 still(0.0, 0.0), along(40.0, 24.0);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec2 end = snapshot.positions.col(k);
    snapshot.flights.push_back({k, -0.5, 0.0, end - 0.5 * along, along, still});
  }
  const Image image = drawn_disks(context->gl(), snapshot);
  CHECK(covered(image, 0, 100) == doctest::Approx(disk_area(20.0)).epsilon(0.01));
  CHECK(covered(image, 100) == doctest::Approx(disk_area(6.0) + disk_area(1.2)).epsilon(0.015));
  // In the middle of its way the large disk covers a pixel all the time: it moves by 23.3 pixels.
  CHECK(pixel(image, 40, kUnitSize.height - 75).alpha >= 254);
  CHECK(pixel(image, 140, kUnitSize.height - 75).alpha < 180);
}

TEST_CASE("Mixture disks: the width of a trail is a fifth of the diameter of its disk") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = unequal_disks({{{180.0, 80.0}, 20.0}, {{180.0, 30.0}, 10.0}});
  const Vec2 still(0.0, 0.0), along(80.0, 0.0);
  for (std::uint32_t k = 0; k < 2; ++k) {
    const Vec2 end = snapshot.positions.col(k);
    snapshot.flights.push_back({k, -2.0, 0.0, end - 2.0 * along, along, still});
  }
  const Canvas canvas = blank_canvas(context->gl(), kUnitSize, kClear);
  TrailLayer(context->gl())
      .draw(snapshot, snapshot.flights, kUnitProjection, {ColourBy::None, {}, kDarkTheme.disk},
            2.0);
  const Image image = canvas.read();
  const auto width_at = [&](int x, int from, int to) {
    double sum = 0.0, most = 0.0;
    for (int up = from; up < to; ++up) {
      const double opacity = pixel(image, x, kUnitSize.height - 1 - up).alpha / 255.0;
      sum += opacity;
      most = std::max(most, opacity);
    }
    return sum / most;
  };
  for (const int x : {100, 140, 160}) {
    CHECK(width_at(x, 55, 105) == doctest::Approx(8.0).epsilon(0.03));
    CHECK(width_at(x, 10, 50) == doctest::Approx(4.0).epsilon(0.03));
  }
}

TEST_CASE("Mixture disks: each has the colour of its species, and plain colours without species") {
  const auto context = open_context(Backend::Auto);
  const Snapshot snapshot = unequal_disks({{{50.0, 60.0}, 30.0}, {{140.0, 60.0}, 10.0}});
  DiskColours colours{ColourBy::Species, {}, kDarkTheme.disk};
  const auto colour_at = [&](int x) {
    const Canvas canvas = blank_canvas(context->gl(), kUnitSize);
    DiskLayer(context->gl()).draw(snapshot, kUnitProjection, colours);
    return pixel(canvas.read(), x, 60);
  };
  CHECK(difference(colour_at(140), kDarkTheme.disk) <= 1);
  colours.species = {{200, 30, 20}, {10, 90, 220}};
  CHECK(difference(colour_at(50), {200, 30, 20}) <= 1);
  CHECK(difference(colour_at(140), {10, 90, 220}) <= 1);
}

TEST_CASE("Mixture disks: each has the colour of its diameter on a scale") {
  const auto context = open_context(Backend::Auto);
  const Snapshot snapshot = unequal_disks({{{50.0, 60.0}, 30.0}, {{140.0, 60.0}, 10.0}});
  const ColourScale scale{colour_map(Palette::Viridis), 0.0, 120.0};
  const Canvas canvas = blank_canvas(context->gl(), kUnitSize);
  DiskLayer(context->gl()).draw(snapshot, kUnitProjection, {ColourBy::Diameter, scale, {}});
  const Image image = canvas.read();
  CHECK(difference(pixel(image, 50, 60), scale(60.0)) <= 1);
  CHECK(difference(pixel(image, 140, 60), scale(20.0)) <= 1);
}

TEST_CASE("Mixture disks: the marks of their angles have the sizes of the disks") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = unequal_disks({{{50.0, 60.0}, 40.0}, {{150.0, 60.0}, 15.0}});
  const Image unmarked = drawn_disks(context->gl(), snapshot);
  snapshot.angles = {0.0, 0.5 * std::numbers::pi};
  const Image image = drawn_disks(context->gl(), snapshot);
  const auto changes = [&](int x, int y) {
    return difference(pixel(image, x, y), pixel(unmarked, x, y)) > 40;
  };
  // From the centre to the rim; half the width is 8 % of the radius.
  for (const int x : {52, 65, 80}) CHECK(changes(x, 60));
  for (const int y : {57, 52, 49}) CHECK(changes(150, y));
  CHECK(changes(65, 58));
  CHECK_FALSE(changes(65, 55));
  CHECK_FALSE(changes(152, 52));
  CHECK_FALSE(changes(45, 60));
}

}  // namespace clatter
