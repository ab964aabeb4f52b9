#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "render/layers/average_layer.h"
#include "render/layers/disk_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr double kAlwaysPoints = 1e9, kAlwaysSquares = 0.0;

Image draw(const Gl& gl, const Snapshot& snapshot, double largest_point,
           ColourBy colour_by = ColourBy::None) {
  const Canvas canvas = blank_canvas(gl, kUnitSize);
  DiskLayer(gl, largest_point)
      .draw(snapshot, kUnitProjection,
            {colour_by, {colour_map(Palette::Viridis)}, kDarkTheme.disk});
  return canvas.read();
}

struct Circle {
  double x = 0.0, y = 0.0;  // centre, pixels from the lower left corner
  double radius = 0.0;
};

// From the moments of all pixels that differ from the background. The rim is darker than the disk,
// but counts fully: the weight of a pixel is its coverage, below 1 at the edge only.
Circle measure(const Image& image) {
  double area = 0.0, x_sum = 0.0, y_sum = 0.0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const double weight = pixel(image, x, y) == kDarkTheme.background ? 0.0 : 1.0;
      area += weight;
      x_sum += weight * (x + 0.5);
      y_sum += weight * (image.size.height - y - 0.5);
    }
  }
  return {x_sum / area, y_sum / area, std::sqrt(area / M_PI)};
}

}  // namespace

TEST_CASE("Disk layer: a disk that follows a wall out of the box is drawn there only") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({-4.0 + 100.0, 60.0}, 40.0);
  snapshot.box = Vec2(100.0, kUnitSize.height);
  const Image still = draw(context->gl(), snapshot, kAlwaysPoints);
  snapshot.wall_displacement[kRight] = -16.0;
  const Image swung = draw(context->gl(), snapshot, kAlwaysPoints);
  CHECK(pixel(swung, 104, 60) == kDarkTheme.disk);
  CHECK(pixel(swung, 90, 60) == pixel(still, 90, 60));
  CHECK(difference(pixel(still, 104, 60), kDarkTheme.disk) > 50);
}

TEST_CASE("Disk layer: a disk is drawn where it is and as large as it is") {
  const auto context = open_context(Backend::Auto);
  for (double largest_point : {kAlwaysPoints, kAlwaysSquares}) {
    CAPTURE(largest_point);
    for (Vec2 centre : {Vec2(60.0, 50.0), Vec2(61.0, 50.0), Vec2(77.3, 41.8)}) {
      const Circle circle = measure(draw(context->gl(), one_disk(centre, 40.0), largest_point));
      CHECK(std::abs(circle.x - centre.x()) < 0.1);
      CHECK(std::abs(circle.y - centre.y()) < 0.1);
      CHECK(circle.radius > 20.0);  // every pixel touched has its full weight
      CHECK(circle.radius < 20.6);
    }
  }
}

TEST_CASE("Disk layer: points and squares give the same picture") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({60.2, 50.7}, 31.0);
  std::vector<Vec2> places = {{60.2, 50.7}}, velocities = {{0.0, 0.0}};
  for (double x : {0.0, 15.6, 120.0, 190.1}) {
    places.emplace_back(x, 0.4 * x + 3.3);
    velocities.emplace_back(0.005 * x, 0.0);
  }
  snapshot.positions = as_columns(places);
  snapshot.velocities = as_columns(velocities);
  for (double diameter : {3.1, 7.7, 40.0}) {
    snapshot.diameter = diameter;
    const Image points = draw(context->gl(), snapshot, kAlwaysPoints, ColourBy::Speed);
    const Image squares = draw(context->gl(), snapshot, kAlwaysSquares, ColourBy::Speed);
    CHECK(difference(points, squares) <= 1);
  }
}

TEST_CASE("Disk layer: particles whose angles are known have a mark that turns with them") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({100.0, 60.0}, 40.0);
  const Image unmarked = draw(context->gl(), snapshot, kAlwaysPoints);
  for (const double angle : {0.0, 0.5 * M_PI, 2.0, -3.0}) {
    snapshot.angles = {angle};
    for (double largest_point : {kAlwaysPoints, kAlwaysSquares}) {
      const Image image = draw(context->gl(), snapshot, largest_point);
      for (const double radius : {4.0, 10.0, 14.0}) {
        const Vec2 place = Vec2(100.0, 60.0) + radius * Vec2(std::cos(angle), -std::sin(angle));
        const int x = static_cast<int>(place.x()), y = static_cast<int>(place.y());
        CHECK(difference(pixel(image, x, y), kDarkTheme.disk) > 60);
        CHECK(pixel(image, 200 - x - 1, 120 - y - 1) == kDarkTheme.disk);
      }
    }
  }
  snapshot.angles.clear();
  CHECK(difference(draw(context->gl(), snapshot, kAlwaysPoints), unmarked) == 0);
}

TEST_CASE("Disk layer: particles beyond the largest point of the driver are drawn as well") {
  const auto context = open_context(Backend::Auto);
  const Canvas canvas = blank_canvas(context->gl(), {1200, 1200});
  Snapshot snapshot = one_disk({0.5, 0.5}, 1.0);
  snapshot.box = Vec2(10.0, 10.0);
  const Projection close{{{0.6, 0.6}, 1.2}, {1200, 1200}};  // centre (500, 700), radius 500 pixels
  DiskLayer(context->gl())
      .draw(snapshot, close, {ColourBy::None, {colour_map(Palette::Viridis)}, kDarkTheme.disk});
  const Image image = canvas.read();
  CHECK(pixel(image, 500, 700) == kDarkTheme.disk);
  CHECK(pixel(image, 20, 700) == kDarkTheme.disk);
  CHECK(pixel(image, 980, 700) == kDarkTheme.disk);
  CHECK(pixel(image, 1010, 700) == kDarkTheme.background);
}

TEST_CASE("Disk layer: a disk with its centre outside the picture shows its part inside") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({-5.0, 60.0}, 20.0);
  const Image image = draw(context->gl(), snapshot, kAlwaysPoints);
  CHECK(pixel(image, 1, 60) == kDarkTheme.disk);
  CHECK(pixel(image, 6, 60) == kDarkTheme.background);
}

TEST_CASE("Disk layer: a disk on a periodic border is drawn on both sides of the box") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({2.0, 60.0}, 20.0);
  CHECK(pixel(draw(context->gl(), snapshot, kAlwaysPoints), 196, 60) == kDarkTheme.background);
  snapshot.walls[kLeft].reset();
  snapshot.walls[kRight].reset();
  CHECK(pixel(draw(context->gl(), snapshot, kAlwaysPoints), 196, 60) == kDarkTheme.disk);

  snapshot.walls.fill({});
  snapshot.positions = Vec2(199.0, 119.0);
  const Image corners = draw(context->gl(), snapshot, kAlwaysPoints);
  for (int x : {2, 197}) {
    for (int y : {2, 117}) CHECK(pixel(corners, x, y) == kDarkTheme.disk);
  }
}

TEST_CASE("Disk layer: particles smaller than a pixel send the light of their area") {
  const auto context = open_context(Backend::Auto);
  const Image image = draw(context->gl(), one_disk({60.5, 60.5}, 0.5), kAlwaysPoints);
  const double area = M_PI / 16.0;
  const auto light = [](std::uint8_t channel) { return linear_light(channel); };
  const double expected =
      area * light(kDarkTheme.disk.green) + (1.0 - area) * light(kDarkTheme.background.green);
  CHECK(light(pixel(image, 60, 59).green) == doctest::Approx(expected).epsilon(0.02));
  CHECK(pixel(image, 59, 59) == kDarkTheme.background);
}

namespace {

// Particles with an area fraction of one half, on a lattice, in all colours.
Snapshot many_disks(double diameter) {
  Snapshot snapshot = one_disk({0.0, 0.0}, diameter);
  std::vector<Vec2> places, velocities;
  const double apart = 1.26 * diameter;
  for (double y = diameter; y < kUnitSize.height - diameter; y += apart) {
    for (double x = diameter; x < kUnitSize.width - diameter; x += apart) {
      places.emplace_back(x + 0.1 * std::sin(7.0 * y), y + 0.1 * std::cos(5.0 * x));
      velocities.emplace_back(0.5 + 0.5 * std::sin(0.2 * x) * std::cos(0.3 * y), 0.0);
    }
  }
  snapshot.positions = as_columns(places);
  snapshot.velocities = as_columns(velocities);
  return snapshot;
}

std::array<double, 3> mean_colour(const Image& image) {
  std::array<double, 3> mean{};
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (i % 4 < 3) mean[i % 4] += image.rgba[i] / (0.25 * image.rgba.size());
  }
  return mean;
}

}  // namespace

TEST_CASE(
    "Disk layer: particles look the same on both sides of the radius below which they have no "
    "shape") {
  const auto context = open_context(Backend::Auto);
  const double switch_over = 2.0 * Coverage::kLargestRadius;
  Snapshot snapshot = many_disks(switch_over);
  for (const ColourBy colour_by : {ColourBy::None, ColourBy::Speed}) {
    snapshot.diameter = switch_over - 1e-6;
    const Image light = draw(context->gl(), snapshot, kAlwaysPoints, colour_by);
    snapshot.diameter = switch_over + 1e-6;
    const Image shapes = draw(context->gl(), snapshot, kAlwaysPoints, colour_by);
    for (int channel : {0, 1, 2}) {
      CHECK(std::abs(mean_colour(light)[channel] - mean_colour(shapes)[channel]) < 2.0);
    }
    CHECK(structural_similarity(light, shapes) >= 0.98);
    CHECK(difference(light, shapes) > 0);
  }
}

TEST_CASE("Disk layer: small disks have the light of their shapes, drawn larger and averaged") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  for (const double diameter : {0.8, 1.5, 2.5}) {
    CAPTURE(diameter);
    const Snapshot snapshot = many_disks(diameter);
    const Image light = draw(gl, snapshot, kAlwaysPoints, ColourBy::Speed);
    const Canvas fine = blank_canvas(gl, {4 * kUnitSize.width, 4 * kUnitSize.height});
    DiskLayer(gl, kAlwaysPoints)
        .draw(snapshot, {kUnitProjection.camera, kUnitSize, 4},
              {ColourBy::Speed, {colour_map(Palette::Viridis)}, kDarkTheme.disk});
    const Canvas canvas = blank_canvas(gl, kUnitSize);
    AverageLayer(gl).draw(fine, 4);
    const Image shapes = canvas.read();
    for (int channel : {0, 1, 2}) {
      CHECK(std::abs(mean_colour(light)[channel] - mean_colour(shapes)[channel]) < 2.0);
    }
    CHECK(structural_similarity(light, shapes) >= 0.98);
  }
}

}  // namespace clatter
