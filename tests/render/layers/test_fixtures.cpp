#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "render/layers/renderer.h"
#include "render/palette.h"
#include "tests/render/optional_context.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

// An empty walled box of disks, whose picture has 10 pixels per unit of length.
constexpr Size kFixtureSize{400, 300};
const Camera kFixtureCamera{{20.0, 15.0}, 40.0};

Snapshot empty_box() {
  Snapshot snapshot;
  snapshot.box = Vec2(40.0, 30.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions.resize(2, 0);
  snapshot.velocities.resize(2, 0);
  return snapshot;
}

Obstacle ball_at(const VecX& centre, double radius) {
  Obstacle ball;
  ball.centre = centre;
  ball.radius = radius;
  return ball;
}

Obstacle box_between(const VecX& from, const VecX& to) {
  Obstacle box;
  box.kind = ObstacleKind::Box;
  box.from = from;
  box.to = to;
  return box;
}

Partition across(Axis axis, double position, const std::vector<Hole>& holes = {}) {
  Partition partition;
  partition.axis = axis;
  partition.position = position;
  partition.holes = holes;
  return partition;
}

Hole hole_between(double from, double to) {
  return {{from}, {to}};
}

View fixture_view() {
  View view;
  view.overlay = false;
  view.range = {ColourRange::Given, {0.0, 4.0}};
  return view;
}

Image picture_of(const Snapshot& snapshot, const View& view = fixture_view(), int samples = 1) {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), samples);
  return draw(renderer, context->gl(), snapshot, kFixtureCamera, kFixtureSize, view);
}

// The colour at a place in the box.
Colour colour_at(const Image& image, double x, double y) {
  return pixel(image, static_cast<int>(10.0 * x), static_cast<int>(10.0 * (30.0 - y)));
}

// The area in world units that a body covers: without the white pixels around it. A pixel of the
// outline belongs to the body if it is darker than half of the outline.
double covered_area(const Image& image) {
  const auto [width, height] = image.size;
  std::vector<bool> outside(image.rgba.size() / 4);
  std::vector<std::array<int, 2>> found{{0, 0}};
  outside[0] = true;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto [x, y] = found[k];
    for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      const std::size_t index = static_cast<std::size_t>(v) * width + u;
      const int half = (255 - kDarkTheme.static_wall.red) / 2;
      if (outside[index] || 255 - pixel(image, u, v).red > half) continue;
      outside[index] = true;
      found.push_back({u, v});
    }
  }
  return (static_cast<double>(width) * height - static_cast<double>(found.size())) / 100.0;
}

View light_view() {
  View view = fixture_view();
  view.background = Rgb{255, 255, 255};
  return view;
}

constexpr Colour kWhitePaper{255, 255, 255};

}  // namespace

TEST_CASE("Fixtures: a drawn ball has its area, at its place") {
  for (const double radius : {2.0, 5.0, 9.7}) {
    CAPTURE(radius);
    Snapshot snapshot = empty_box();
    snapshot.obstacles = {ball_at(Vec2(17.3, 14.1), radius)};
    const Image image = picture_of(snapshot, light_view());
    const double area = std::numbers::pi * radius * radius;
    CHECK(covered_area(image) == doctest::Approx(area).epsilon(0.01));
    for (int k = 0; k < 16; ++k) {
      const double angle = k * std::numbers::pi / 8.0;
      const Vec2 direction(std::cos(angle), std::sin(angle));
      const Vec2 inside = Vec2(17.3, 14.1) + (radius - 0.15) * direction;
      const Vec2 outside = Vec2(17.3, 14.1) + (radius + 0.15) * direction;
      CHECK(difference(colour_at(image, inside.x(), inside.y()), kWhitePaper) > 30);
      CHECK(colour_at(image, outside.x(), outside.y()) == kWhitePaper);
    }
  }
}

TEST_CASE("Fixtures: a polygon that is not convex has its area, and a notch") {
  Snapshot snapshot = empty_box();
  Obstacle notched;
  notched.kind = ObstacleKind::Polygon;
  notched.corners = {{10, 5}, {26, 5}, {26, 21}, {18, 13}, {10, 21}};
  snapshot.obstacles = {notched};
  const Image image = picture_of(snapshot, light_view());
  // A square of 16 without a triangle of base 16 and height 8.
  CHECK(covered_area(image) == doctest::Approx(256.0 - 64.0).epsilon(0.01));
  CHECK(colour_at(image, 18.0, 14.0) == kWhitePaper);
  CHECK(difference(colour_at(image, 18.0, 12.0), kWhitePaper) > 30);
  // The order of the corners is free.
  std::ranges::reverse(snapshot.obstacles[0].corners);
  CHECK(covered_area(picture_of(snapshot, light_view())) == doctest::Approx(192.0).epsilon(0.01));
}

TEST_CASE("Fixtures: a partition is a line at its place, and its holes are open") {
  for (const Axis axis : {Axis::X, Axis::Y}) {
    CAPTURE(static_cast<int>(axis));
    Snapshot snapshot = empty_box();
    snapshot.partitions = {across(axis, 12.05, {hole_between(5.0, 9.0), hole_between(20.0, 30.0)})};
    const Image image = picture_of(snapshot);
    const auto at = [&](double place, double along) {
      return axis == Axis::X ? colour_at(image, place, along) : colour_at(image, along, place);
    };
    for (const double along : {1.0, 4.85, 9.15, 12.0, 19.8}) {
      CAPTURE(along);
      CHECK(at(12.05, along) == kDarkTheme.static_wall);
      // 300 pixels have lines of one pixel, and partitions of 2.5.
      CHECK(at(11.85, along) == kDarkTheme.background);
      CHECK(at(12.25, along) == kDarkTheme.background);
    }
    for (const double along : {5.15, 7.0, 8.85, 20.2, 25.0, 29.5}) {
      CAPTURE(along);
      CHECK(at(12.05, along) == kDarkTheme.background);
    }
  }
}

TEST_CASE("Fixtures: a membrane has gaps in its line, which a solid partition has not") {
  Snapshot snapshot = empty_box();
  snapshot.partitions = {across(Axis::X, 12.0), across(Axis::Y, 12.0)};
  const auto gaps = [](const Image& image) {
    int faint = 0;
    for (double place = 14.0; place < 29.0; place += 0.1) {
      faint += difference(colour_at(image, 12.0, place), kDarkTheme.static_wall) > 40;
      faint += difference(colour_at(image, place, 12.0), kDarkTheme.static_wall) > 40;
    }
    return faint;
  };
  CHECK(gaps(picture_of(snapshot)) == 0);
  for (Partition& partition : snapshot.partitions) partition.passes = {"small"};
  const int faint = gaps(picture_of(snapshot));
  CHECK(faint > 80);
  CHECK(faint < 220);
}

TEST_CASE("Fixtures: colours tell the law") {
  const auto outline = [](const FixtureLaw& law) {
    Snapshot snapshot = empty_box();
    snapshot.obstacles = {box_between(Vec2(10.0, 10.0), Vec2(20.0, 20.0))};
    snapshot.obstacles[0].law = law;
    snapshot.partitions = {across(Axis::X, 30.0)};
    snapshot.partitions[0].law = law;
    const Image image = picture_of(snapshot);
    const Colour colour = colour_at(image, 10.0, 15.0);
    CHECK(colour_at(image, 30.0, 15.0) == colour);
    return colour;
  };
  FixtureLaw driven, thermal;
  driven.of_all.drive_speed = 1.0;
  thermal.of_all.temperature = 2.0;
  CHECK(outline({}) == kDarkTheme.static_wall);
  CHECK(outline(driven) == kDarkTheme.driven_wall);
  const Colour hot = outline(thermal);
  CHECK(difference(hot, kDarkTheme.static_wall) > 50);
  thermal.of_all.temperature = 0.01;
  CHECK(difference(hot, outline(thermal)) > 50);
}

TEST_CASE("Fixtures: the snapshots of a run have those of its scene") {
  const Scene scene = parse_scene(R"(
      box.size = [16.0, 12.0]
      particles.count = 5
      [[obstacle]]
      kind = "ball"
      centre = [8.0, 6.0]
      radius = 2.0
      [[partition]]
      position = 3.0)",
                                  "fixtures");
  ScheduledRun<2> run(scene, 1);
  const Snapshot snapshot = run.snapshot();
  CHECK(snapshot.obstacles == scene.obstacles);
  CHECK(snapshot.partitions == scene.partitions);
  CHECK(snapshot.obstacles.size() == 1);
  CHECK(snapshot.partitions.size() == 1);
}

TEST_CASE("Fixtures: only the teeth of a driven body move") {
  for (const bool driven : {true, false}) {
    Snapshot snapshot = empty_box();
    snapshot.obstacles = {ball_at(Vec2(20.0, 15.0), 8.0)};
    if (driven) snapshot.obstacles[0].law.of_all.drive_speed = 1.0;
    const Image start = picture_of(snapshot);
    snapshot.time = 0.3;
    CHECK((difference(start, picture_of(snapshot)) > 50) == driven);
  }
}

TEST_CASE("Fixtures: a body covers the heatmap") {
  Snapshot snapshot = empty_box();
  snapshot.obstacles = {ball_at(Vec2(20.0, 15.0), 6.0)};
  View view = fixture_view();
  const Image alone = picture_of(snapshot, view);
  view.field = Quantity::Density;
  view.field_style = FieldStyle::Cells;
  FieldMap density{Quantity::Density, {4, 3}, {}};
  for (int i = 0; i < 12; ++i) density.values.push_back(0.1 * i);
  snapshot.field = density;
  const Image covered = picture_of(snapshot, view);
  for (const double x : {14.5, 17.0, 20.0, 25.5}) {
    CHECK(colour_at(covered, x, 15.0) == colour_at(alone, x, 15.0));
  }
  CHECK(difference(colour_at(covered, 13.5, 15.0), colour_at(alone, 13.5, 15.0)) > 10);
}

TEST_CASE("Fixtures: disks are in front of a partition") {
  Snapshot snapshot = empty_box();
  snapshot.diameter = 4.0;
  snapshot.positions = Vec2(22.0, 15.0);
  snapshot.velocities = Vec2(0.0, 0.0);
  const Image disk = picture_of(snapshot);
  snapshot.partitions = {across(Axis::X, 21.0)};
  const Image both = picture_of(snapshot);
  CHECK(colour_at(both, 21.0, 15.0) == colour_at(disk, 21.0, 15.0));
  CHECK(colour_at(both, 21.0, 19.0) == kDarkTheme.static_wall);
}

TEST_CASE("Fixtures: a ball at a periodic border has an image, and at a wall it is cut") {
  Snapshot snapshot = empty_box();
  snapshot.obstacles = {ball_at(Vec2(20.0, 29.0), 4.0)};
  Image image = picture_of(snapshot);
  CHECK(colour_at(image, 20.0, 1.0) == kDarkTheme.background);
  snapshot.walls[kBottom] = snapshot.walls[kTop] = std::nullopt;
  image = picture_of(snapshot);
  // The image reaches from -5 to 3.
  for (const double y : {0.5, 2.0, 2.8, 25.2, 29.0}) {
    CHECK(difference(colour_at(image, 20.0, y), kDarkTheme.background) > 20);
  }
  CHECK(colour_at(image, 20.0, 3.2) == kDarkTheme.background);
}

TEST_CASE("Fixtures: copies of a periodic box have faint fixtures") {
  Snapshot snapshot = empty_box();
  snapshot.box = Vec2(10.0, 30.0);
  snapshot.walls[kLeft] = snapshot.walls[kRight] = std::nullopt;
  snapshot.obstacles = {ball_at(Vec2(5.0, 15.0), 3.0)};
  snapshot.partitions = {across(Axis::Y, 25.0, {hole_between(4.0, 6.0)})};
  View view = fixture_view();
  view.tiling = true;
  const Image image = picture_of(snapshot, view);
  const Colour body = colour_at(image, 5.0, 15.0), copy = colour_at(image, 25.0, 15.0);
  CHECK(difference(copy, mix(kDarkTheme.background, body, 0.5)) <= 2);
  CHECK(difference(copy, kDarkTheme.background) > 10);
  const Colour line = mix(kDarkTheme.background, kDarkTheme.static_wall, 0.5);
  for (const double x : {12.0, 18.0, 20.0, 22.0}) {
    CHECK(difference(colour_at(image, x, 25.0), line) <= 2);
  }
  CHECK(colour_at(image, 25.0, 25.0) == kDarkTheme.background);
}

TEST_CASE("Fixtures: without a background bodies are opaque") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), 1, true);
  Snapshot snapshot = empty_box();
  snapshot.obstacles = {ball_at(Vec2(20.0, 15.0), 6.0)};
  const Image image =
      draw(renderer, context->gl(), snapshot, kFixtureCamera, kFixtureSize, fixture_view());
  CHECK(colour_at(image, 20.0, 15.0).alpha == 255);
  CHECK(colour_at(image, 30.0, 15.0).alpha == 0);
}

namespace {

// An empty box of spheres, seen along z with 10 pixels per unit of length.
Snapshot empty_space() {
  Snapshot snapshot;
  snapshot.box = Vec3(40.0, 30.0, 20.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions.resize(3, 0);
  snapshot.velocities.resize(3, 0);
  return snapshot;
}

void add_sphere(Snapshot& snapshot, const Vec3& place, double diameter) {
  snapshot.diameter = diameter;
  snapshot.positions = place;
  snapshot.velocities = Vec3(1.0, 0.0, 0.0);
}

}  // namespace

TEST_CASE("Fixtures in space: a ball has its area") {
  Snapshot with = empty_space();
  const Image without = picture_of(with, light_view(), 2);
  with.obstacles = {ball_at(Vec3(17.3, 14.1, 10.0), 7.0)};
  const Image image = picture_of(with, light_view(), 2);
  double pixels = 0.0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      pixels += difference(pixel(image, x, y), pixel(without, x, y)) > 40;
    }
  }
  CHECK(pixels / 100.0 == doctest::Approx(49.0 * std::numbers::pi).epsilon(0.01));
}

TEST_CASE("Fixtures in space: bodies hide the spheres behind them, not those in front") {
  for (const Obstacle& obstacle : {ball_at(Vec3(20.0, 15.0, 10.0), 5.0),
                                   box_between(Vec3(15.0, 10.0, 8.0), Vec3(25.0, 20.0, 12.0))}) {
    for (const double diameter : {2.0, 0.25}) {  // with and without a shape
      CAPTURE(diameter);
      Snapshot snapshot = empty_space();
      snapshot.diameter = diameter;
      snapshot.obstacles = {obstacle};
      const Image alone = picture_of(snapshot);
      add_sphere(snapshot, Vec3(20.05, 15.05, 3.0), diameter);
      CHECK(difference(alone, picture_of(snapshot)) == 0);
      add_sphere(snapshot, Vec3(20.05, 15.05, 17.0), diameter);
      CHECK(difference(colour_at(alone, 20.05, 15.05),
                       colour_at(picture_of(snapshot), 20.05, 15.05)) > 40);
    }
  }
}

TEST_CASE("Fixtures in space: a partition tints the spheres behind it, and its holes are open") {
  Snapshot snapshot = empty_space();
  const Hole hole{{15.0, 10.0}, {25.0, 20.0}};
  const Partition plate = across(Axis::Z, 10.0, {hole});
  const auto changes = [&](const Vec3& sphere) {
    snapshot.partitions.clear();
    add_sphere(snapshot, sphere, 3.0);
    const Image without = picture_of(snapshot);
    snapshot.partitions = {plate};
    const Image with = picture_of(snapshot);
    return difference(colour_at(with, sphere.x(), sphere.y()),
                      colour_at(without, sphere.x(), sphere.y()));
  };
  CHECK(changes(Vec3(20.0, 15.0, 3.0)) == 0);  // behind the hole
  CHECK(changes(Vec3(5.0, 15.0, 17.0)) == 0);  // in front of the plate
  const int tint = changes(Vec3(5.0, 15.0, 3.0));
  CHECK(tint > 10);
  CHECK(tint < 100);
}

TEST_CASE("Fixtures in space: colours tell the law") {
  const auto colours = [](const FixtureLaw& law) {
    Snapshot snapshot = empty_space();
    snapshot.obstacles = {ball_at(Vec3(10.0, 15.0, 10.0), 5.0),
                          box_between(Vec3(25.0, 10.0, 8.0), Vec3(35.0, 20.0, 12.0))};
    for (Obstacle& obstacle : snapshot.obstacles) obstacle.law = law;
    const Image image = picture_of(snapshot);
    return std::pair(colour_at(image, 10.0, 15.0), colour_at(image, 30.0, 15.0));
  };
  FixtureLaw driven, thermal;
  driven.of_all.drive_speed = 1.0;
  thermal.of_all.temperature = 2.0;
  const auto [ball, box] = colours({});
  for (const FixtureLaw& law : {driven, thermal}) {
    const auto [other_ball, other_box] = colours(law);
    CHECK(difference(ball, other_ball) > 40);
    CHECK(difference(box, other_box) > 40);
  }
  const auto [orange, orange_box] = colours(driven);
  CHECK(orange.red > 2 * orange.blue);
  CHECK(orange_box.red > 2 * orange_box.blue);
}

TEST_CASE("Fixtures in space: the edge of a ball blends with the sphere behind it") {
  Snapshot snapshot = empty_space();
  add_sphere(snapshot, Vec3(20.0, 15.0, 6.0), 12.0);
  snapshot.obstacles = {ball_at(Vec3(20.03, 15.0, 15.0), 3.0)};
  const Image image = picture_of(snapshot, light_view());
  // Ball and sphere have luminances below 0.45. With a share of the white background the edge would
  // be brighter.
  for (double x = 16.5; x < 23.5; x += 0.1) {
    CAPTURE(x);
    CHECK(luminance(colour_at(image, x, 15.05)) < 0.5);
  }
}

TEST_CASE("Fixtures in space: the faces of a box do not cover its edges") {
  Snapshot snapshot = empty_space();
  snapshot.obstacles = {box_between(Vec3(10.0, 8.0, 5.0), Vec3(30.0, 22.0, 15.0))};
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), 4);
  Camera turned = kFixtureCamera;
  turned.orbit = {.z = 10.0, .azimuth = 30.0, .elevation = 20.0, .view_angle = 30.0};
  const Image image = draw(renderer, context->gl(), snapshot, turned, kFixtureSize, fixture_view());
  const Eye eye({turned, kFixtureSize});
  const Colour edge = mix(kDarkTheme.static_wall, kDarkTheme.text, 0.45);
  const Vec3 corner(30.0, 22.0, 15.0);
  for (const Vec3& other : {Vec3(10.0, 22.0, 15.0), Vec3(30.0, 8.0, 15.0), Vec3(30.0, 22.0, 5.0)}) {
    double off = 0.0;
    for (int k = 1; k < 100; ++k) {
      const Vec2 place = eye.pixels(eye.seen(corner + 0.01 * k * (other - corner)));
      off += 0.01 * difference(edge, pixel(image, static_cast<int>(place.x()),
                                           static_cast<int>(300.0 - place.y())));
    }
    CHECK(off < 5.0);
  }
}

TEST_CASE("Fixtures in space: a slab and the walls cut bodies") {
  Snapshot snapshot = empty_space();
  snapshot.obstacles = {box_between(Vec3(5.0, 10.0, 2.0), Vec3(15.0, 20.0, 6.0)),
                        ball_at(Vec3(39.0, 15.0, 10.0), 5.0)};
  View view = fixture_view();
  const Image whole = picture_of(snapshot, view);
  view.slab = Slab{Axis::Z, 8.0, 12.0};
  const Image cut = picture_of(snapshot, view);
  snapshot.obstacles.clear();
  const Image empty = picture_of(snapshot, view);
  CHECK(difference(colour_at(whole, 10.0, 15.0), colour_at(empty, 10.0, 15.0)) > 20);
  CHECK(colour_at(cut, 10.0, 15.0) == colour_at(empty, 10.0, 15.0));
  CHECK(difference(colour_at(cut, 37.0, 15.0), colour_at(empty, 37.0, 15.0)) > 20);
}

TEST_CASE("Fixtures in space: a membrane is fainter than a solid partition") {
  Snapshot snapshot = empty_space();
  add_sphere(snapshot, Vec3(5.0, 15.0, 3.0), 3.0);
  const Colour alone = colour_at(picture_of(snapshot), 5.0, 15.0);
  snapshot.partitions = {across(Axis::Z, 10.0)};
  const int solid = difference(alone, colour_at(picture_of(snapshot), 5.0, 15.0));
  snapshot.partitions[0].passes = {"small"};
  const int membrane = difference(alone, colour_at(picture_of(snapshot), 5.0, 15.0));
  CHECK(membrane > 0);
  CHECK(solid > 2 * membrane);
}

TEST_CASE("Fixtures in space: dashes cross a hole with a valve, and an open one is empty") {
  Snapshot snapshot = empty_space();
  const auto changed_pixels = [&](const Hole& hole) {
    snapshot.partitions.clear();
    const Image without = picture_of(snapshot);
    snapshot.partitions = {across(Axis::Z, 10.0, {hole})};
    const Image with = picture_of(snapshot);
    int changed = 0;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) {
        changed += difference(pixel(with, 160 + x, 110 + y), pixel(without, 160 + x, 110 + y)) > 10;
      }
    }
    return changed;
  };
  Hole hole{{15.0, 10.0}, {25.0, 20.0}};
  CHECK(changed_pixels(hole) == 0);
  hole.valve.emplace().faster_than = 1.0;
  // Three lines of 80 pixels in the seen part, more than half of each drawn.
  CHECK(changed_pixels(hole) > 120);
  CHECK(changed_pixels(hole) < 700);
}

TEST_CASE("Fixtures: OpenGL ES draws them as OpenGL does") {
  Snapshot flat = empty_box(), space = empty_space();
  Obstacle triangle;
  triangle.kind = ObstacleKind::Polygon;
  triangle.corners = {{10, 5}, {20, 5}, {15, 12}};
  flat.obstacles = {ball_at(Vec2(30.0, 20.0), 5.0), triangle};
  flat.partitions = {across(Axis::X, 23.0, {hole_between(5.0, 9.0)})};
  space.obstacles = {ball_at(Vec3(30.0, 20.0, 5.0), 5.0),
                     box_between(Vec3(5.0, 5.0, 2.0), Vec3(15.0, 15.0, 6.0))};
  space.partitions = {across(Axis::Z, 10.0, {Hole{{15.0, 10.0}, {25.0, 20.0}}})};
  Camera turned = kFixtureCamera;
  turned.orbit = {.z = 10.0, .azimuth = 30.0, .elevation = 20.0, .view_angle = 30.0};
  const auto pictures = [&](const Gl& gl) {
    Renderer renderer(gl);
    const View view = fixture_view();
    return std::pair(draw(renderer, gl, flat, kFixtureCamera, kFixtureSize, view),
                     draw(renderer, gl, space, turned, kFixtureSize, view));
  };
  const auto es = open_es_context();
  if (!es) return;
  const auto [flat_es, space_es] = pictures(es->gl());
  const auto desktop = open_context(Backend::Auto);
  const auto [flat_desktop, space_desktop] = pictures(desktop->gl());
  CHECK(difference(flat_es, flat_desktop) <= 2);
  CHECK(difference(space_es, space_desktop) <= 4);
}

}  // namespace clatter
