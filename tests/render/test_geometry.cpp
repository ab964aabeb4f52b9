#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "render/contrast_maps.h"
#include "render/layers/renderer.h"
#include "tests/render/optional_context.h"
#include "tests/render/picture.h"
#include "tests/support/messages.h"

// Measurements in a picture agree with the snapshot.

namespace clatter {

using testing::says;

namespace {

constexpr Size kGeometrySize{640, 480};
constexpr double kFastest = 4.0;  // end of the colours' range

// A gas between walls. Disks are drawn one fifth smaller, so that none touches another.
Snapshot gas() {
  const Scene scene = parse_scene(R"(
      box.size = [16.0, 12.0]
      particles.count = 80
      walls.left = { kind = "static" }
      walls.right = { kind = "static" }
      walls.bottom = { kind = "static" }
      walls.top = { kind = "static" })",
                                  "gas");
  ScheduledRun<2> run(scene, 1);
  run.run_until(5.0);
  Snapshot snapshot = run.snapshot();
  snapshot.diameter = 0.8;
  return snapshot;
}

View white_view() {
  View view;
  view.overlay = false;
  view.background = Rgb{255, 255, 255};
  view.range = {ColourRange::Given, {0.0, kFastest}};
  return view;
}

// A spot of the picture: connected pixels outside the background.
struct Spot {
  Vec2 centre;    // pixels from the lower left corner
  double radius;  // of a disk of its area, pixels
  Colour colour;  // in its middle
};

// More than half covered by a rim, which is dark, or by a disk, which is coloured.
bool covered(const Image& image, int x, int y) {
  const Colour colour = pixel(image, x, y);
  return std::min({colour.red, colour.green, colour.blue}) < 188;
}

Spot spot_at(const Image& image, int x, int y, std::vector<bool>& seen) {
  std::vector<std::array<int, 2>> found{{x, y}};
  Vec2 sum(0.0, 0.0);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto [u, v] = found[k];
    sum += Vec2(u + 0.5, image.size.height - v - 0.5);
    for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int s = u + du, t = v + dv;
      if (s < 0 || t < 0 || s >= image.size.width || t >= image.size.height) continue;
      const std::size_t index = static_cast<std::size_t>(t) * image.size.width + s;
      if (seen[index] || !covered(image, s, t)) continue;
      seen[index] = true;
      found.push_back({s, t});
    }
  }
  const auto area = static_cast<double>(found.size());
  const Vec2 centre = sum / area;
  return {centre, std::sqrt(area / std::numbers::pi),
          pixel(image, static_cast<int>(centre.x()),
                image.size.height - 1 - static_cast<int>(centre.y()))};
}

std::vector<Spot> spots_in(const Image& image, const Vec2& low, const Vec2& high) {
  std::vector<bool> seen(image.rgba.size() / 4);
  std::vector<Spot> spots;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::size_t index = static_cast<std::size_t>(y) * image.size.width + x;
      const double up = image.size.height - y;
      if (x < low.x() || x + 1 > high.x() || up - 1 < low.y() || up > high.y()) {
        seen[index] = true;  // a wall
      }
    }
  }
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::size_t index = static_cast<std::size_t>(y) * image.size.width + x;
      if (seen[index] || !covered(image, x, y)) continue;
      seen[index] = true;
      spots.push_back(spot_at(image, x, y, seen));
    }
  }
  return spots;
}

// Differences between the picture and the snapshot; empty: none.
std::string disagreement(const Image& image, const Snapshot& snapshot, const Camera& camera) {
  constexpr double kOff = 0.3;  // pixels; the size of a spot is a whole number of pixels
  const Projection projection{camera, kGeometrySize};
  const Vec2 line(3.0, 3.0);  // the faces of the walls
  std::vector<Spot> spots =
      spots_in(image, projection.pixels({0.0, 0.0}) + line, projection.pixels(snapshot.box) - line);
  if (spots.size() != snapshot.count()) {
    return "there are " + std::to_string(spots.size()) + " spots";
  }
  const ColourScale scale{particle_map(Palette::Viridis, {255, 255, 255}), 0.0, kFastest};
  for (std::size_t i = 0; i < snapshot.count(); ++i) {
    const Vec2 centre = projection.pixels(snapshot.positions.col(i));
    const auto spot = std::ranges::find_if(
        spots, [&](const Spot& spot) { return (spot.centre - centre).norm() < kOff; });
    const std::string disk = "disk " + std::to_string(i);
    if (spot == spots.end()) return disk + " is not where it should be";
    if (std::abs(spot->radius - 0.5 * snapshot.diameter * projection.scale()) > kOff) {
      return disk + " has the radius " + std::to_string(spot->radius);
    }
    if (difference(spot->colour, scale(snapshot.velocities.col(i).norm())) > 1) {
      return disk + " has another colour";
    }
  }
  return "";
}

void check_geometry(Backend backend) {
  const auto context = open_context(backend);
  const Snapshot snapshot = gas();
  const View view = white_view();
  for (const int samples : {1, 2}) {
    Renderer renderer(context->gl(), samples);
    const Camera camera = renderer.fit(snapshot, kGeometrySize, view, {});
    const Canvas canvas(context->gl(), kGeometrySize);
    const auto disagreement_with = [&](const Snapshot& drawn) {
      canvas.bind();
      renderer.draw(drawn, camera, kGeometrySize, view, {});
      return disagreement(canvas.read(), snapshot, camera);
    };
    CHECK(disagreement_with(snapshot) == "");
    const double pixel = camera.width / kGeometrySize.width;
    for (const int i : {0, 17, 79}) {
      for (const Vec2& shift : {Vec2(pixel, 0.0), Vec2(0.0, -pixel)}) {
        Snapshot moved = snapshot;
        moved.positions.col(i) += shift;
        CHECK(disagreement_with(moved) ==
              "disk " + std::to_string(i) + " is not where it should be");
      }
    }
    Snapshot wider = snapshot;
    wider.diameter += 2.0 * pixel;
    CHECK(says(disagreement_with(wider), "has the radius"));
    Snapshot faster = snapshot;
    faster.velocities.col(5) *= 1.2;
    CHECK(disagreement_with(faster) == "disk 5 has another colour");
    Snapshot fewer = snapshot;
    fewer.positions.conservativeResize(2, 79);
    CHECK(disagreement_with(fewer) == "there are 79 spots");
  }
}

}  // namespace

TEST_CASE("Geometry: OSMesa draws centres, radii, colours and count of the snapshot") {
  if (open_or_skip(Backend::Osmesa)) check_geometry(Backend::Osmesa);
}

TEST_CASE("Geometry: EGL draws centres, radii, colours and count of the snapshot") {
  if (open_or_skip(Backend::Egl)) check_geometry(Backend::Egl);
}

}  // namespace clatter
