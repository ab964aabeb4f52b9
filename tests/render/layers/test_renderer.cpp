#include <doctest/doctest.h>

#include <cmath>

#include "render/layers/renderer.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE("Renderer: a picture has room for a wall that swings out of the box") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  Snapshot snapshot = driven_box();
  snapshot.walls[kRight] = Wall{.kind = WallKind::Sinusoidal, .stroke = 6.0, .frequency = 1.0};
  for (Size size : {Size{1280, 720}, {360, 640}}) {
    for (const bool overlay : {false, true}) {
      View view;
      view.overlay = overlay;
      const Camera camera = renderer.fit(snapshot, size, view, kText);
      const Projection projection{camera, size};
      const double face = projection.pixels({23.0, 0.0}).x();
      CHECK(projection.pixels({0.0, 0.0}).x() >= wall_thickness(size) - 0.5);
      CHECK(face + wall_thickness(size) <= size.width + 0.5);
      if (!overlay) continue;
      // No text in the range of the wall.
      snapshot.wall_displacement[kRight] = -3.0;
      const Image with = draw(renderer, context->gl(), snapshot, camera, size, view);
      view.overlay = false;
      const Image without = draw(renderer, context->gl(), snapshot, camera, size, view);
      const Vec2 low = projection.pixels({0.0, 0.0}), high = projection.pixels({23.0, 25.0});
      int written = 0;
      for (int y = static_cast<int>(low.y()) + 1; y < high.y() - 1; ++y) {
        for (int x = static_cast<int>(low.x()) + 1; x < high.x() + wall_thickness(size) - 1; ++x) {
          const int down = size.height - 1 - y;
          written += !(pixel(with, x, down) == pixel(without, x, down));
        }
      }
      CHECK(written == 0);
    }
  }
}

TEST_CASE("Renderer: a picture of several samples a pixel looks like the one of one sample") {
  const auto context = open_context(Backend::Auto);
  View view = view_with_field();
  view.grid = true;
  view.arrows = Quantity::Velocity;
  Snapshot snapshot = driven_box();
  snapshot.walls[kLeft] = Wall{.kind = WallKind::Sinusoidal, .stroke = 1.0, .frequency = 1.0};
  snapshot.arrows =
      ArrowMap{Quantity::Velocity, Vec2(4.0, 4.0), {{Vec2(5.0, 5.0), Vec2(1.5, 1.0)}}};
  for (const Size size : {Size{1280, 720}, {500, 300}, {1080, 1920}}) {
    Renderer normal(context->gl());
    const Camera camera = normal.fit(snapshot, size, view, kText);
    const Image one = draw(normal, context->gl(), snapshot, camera, size, view);
    for (const int samples : {2, 4}) {
      CAPTURE(size.width);
      CAPTURE(samples);
      Renderer finer(context->gl(), samples);
      const Image many = draw(finer, context->gl(), snapshot, camera, size, view);
      CHECK(structural_similarity(one, many) >= 0.98);
      CHECK(difference(one, many) > 10);
      for (std::size_t i = 3; i < many.rgba.size(); i += 4) REQUIRE(many.rgba[i] == 255);
    }
  }
}

// Its samples are averaged in several groups of rows.
TEST_CASE("Renderer: a large picture is whole, and a stop request ends it") {
  const auto context = open_context(Backend::Auto);
  View view;
  view.overlay = false;
  const auto drawn = [&](const StopRequest& stop) {
    Renderer renderer(context->gl(), 2, false, stop);
    return draw(renderer, context->gl(), driven_box(), {{10.0, 12.5}, 40.0}, {3000, 1500}, view);
  };
  const Image image = drawn({});
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) REQUIRE(image.rgba[i] == 255);
  CHECK_THROWS_AS(drawn([] { return true; }), Interrupted);
  int asked = 0;
  CHECK_THROWS_AS(drawn([&] { return ++asked == 4; }), Interrupted);
}

TEST_CASE("Renderer: blur, trails and marks look the same with several samples a pixel") {
  const auto context = open_context(Backend::Auto);
  const Size size{1280, 720};
  View view;
  Snapshot snapshot = driven_box();
  for (std::uint32_t i = 0; i < snapshot.count(); ++i) {
    const Vec2 r = snapshot.positions.col(i), v = snapshot.velocities.col(i);
    snapshot.angles.push_back(0.1 * i);
    snapshot.flights.push_back({i, -1.0, 0.0, r - v, v, Vec2(0.0, 0.0)});
  }
  for (const bool blurred : {false, true}) {
    CAPTURE(blurred);
    snapshot.exposure = blurred ? 0.8 : 0.0;
    view.trails = blurred ? std::nullopt : std::optional(1.0);
    Renderer normal(context->gl()), finer(context->gl(), 4);
    const Camera camera = normal.fit(snapshot, size, view, kText);
    const Image one = draw(normal, context->gl(), snapshot, camera, size, view);
    const Image many = draw(finer, context->gl(), snapshot, camera, size, view);
    CHECK(structural_similarity(one, many) >= 0.98);
    CHECK(difference(one, many) > 10);
  }
}

TEST_CASE("Renderer: the tracer has the colour of the letters, and its path is above the others") {
  const auto context = open_context(Backend::Auto);
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  view.tracer = Tracer{1, 2.0};
  const Vec2 centre(7.0, 5.0);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions = as_columns(std::vector{Vec2(3.0, 5.0), centre});
  snapshot.velocities = Vectors::Zero(2, 2);
  // Through the first disk.
  snapshot.traced = {{1, -1.0, 0.0, Vec2(2.0, 5.0), Vec2(5.0, 0.0), Vec2(0.0, 0.0)}};
  constexpr Size kSize{200, 200};
  Renderer renderer(context->gl());
  const auto drawn = [&] {
    return draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, kSize, view);
  };
  const Image traced = drawn();
  CHECK(pixel(traced, 140, 100) == kDarkTheme.text);
  CHECK(pixel(traced, 60, 92) == kDarkTheme.disk);
  view.tracer->particle = 2;  // none
  snapshot.traced.clear();
  const Image plain = drawn();
  CHECK(pixel(plain, 140, 100) == kDarkTheme.disk);
  const auto excess = [&](int x) { return pixel(traced, x, 100).red - pixel(plain, x, 100).red; };
  CHECK(excess(60) > 10);
  CHECK(excess(100) > excess(45));  // it fades with age
  CHECK(excess(45) > 0);
  CHECK(excess(20) == 0);
}

namespace {

constexpr Size kSpaceSize{800, 800};  // 80 pixels per world unit, and lines of 2 pixels

// Spheres seen along z, in a box whose edges are beyond the picture.
Snapshot spheres(const std::vector<Vec3>& centres) {
  Snapshot snapshot;
  snapshot.box = Vec3(30.0, 30.0, 30.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions = as_columns(centres);
  snapshot.velocities = Vectors::Zero(3, snapshot.positions.cols());
  return snapshot;
}

Image draw_space(const Gl& gl, const Snapshot& snapshot, const View& view, int samples) {
  Renderer renderer(gl, samples);
  const Camera camera{{15.0, 15.0}, 10.0, {.z = 15.0}};
  return draw(renderer, gl, snapshot, camera, kSpaceSize, view);
}

View view_of_spheres() {
  View view;
  view.overlay = false;
  view.colour_by = ColourBy::VelocityX;
  view.range = {ColourRange::Given, {-1.0, 1.0}};
  return view;
}

}  // namespace

TEST_CASE("Renderer: arrows of spheres have the length of their legend, and no sphere hides them") {
  const auto context = open_context(Backend::Auto);
  View view = view_of_spheres();
  Snapshot snapshot = spheres({{15.0, 15.0, 20.0}});
  snapshot.velocities.col(0) = Vec3(1.0, 0.0, 0.0);
  snapshot.arrows = ArrowMap{
      Quantity::Velocity, Vec3(4.0, 5.0, 6.0), {{Vec3(15.0, 15.0, 10.0), Vec3(1.5, 0.0, 0.0)}}};
  for (const int samples : {1, 2}) {
    CAPTURE(samples);
    view.arrows.reset();
    const auto is_text = [](Colour colour) { return difference(colour, kDarkTheme.text) < 60; };
    const auto extent = [&] {
      const Image image = draw_space(context->gl(), snapshot, view, samples);
      int width = 0, height = 0;
      for (int k = 0; k < 800; ++k) {
        width += is_text(pixel(image, k, 400));
        height += is_text(pixel(image, 350, k));
      }
      return std::pair(width, height);
    };
    CHECK(extent() == std::pair(0, 0));  // not requested
    view.arrows = Quantity::Velocity;
    // The largest value fills the shortest side of a cell, 320 pixels.
    CHECK(std::abs(extent().first - 320) <= 4);
    CHECK(extent().second == 2);
  }
}

TEST_CASE("Renderer: trails of spheres are as long as asked for, fade out, and may be hidden") {
  const auto context = open_context(Backend::Auto);
  View view = view_of_spheres();
  // The first sphere flew along x for two time units. The second is in front of its trail.
  Snapshot snapshot = spheres({{18.0, 15.0, 10.0}, {16.0, 15.0, 20.0}});
  const Vec3 velocity(3.0, 0.0, 0.0);
  snapshot.velocities.col(0) = velocity;
  snapshot.flights = {{0, -2.0, 0.0, Vec3(12.0, 15.0, 10.0), velocity, Vec3(0.0, 0.0, 0.0)}};
  for (const int samples : {1, 2}) {
    CAPTURE(samples);
    view.trails.reset();
    const Image without = draw_space(context->gl(), snapshot, view, samples);
    view.trails = 1.0;
    const Image with = draw_space(context->gl(), snapshot, view, samples);
    // The trail is seen at world coordinate x.
    const auto seen = [&](double x) {
      const int column = static_cast<int>(std::lround((x - 10.0) * 80.0));
      return difference(pixel(with, column, 400), pixel(without, column, 400));
    };
    CHECK(seen(14.9) == 0);
    CHECK(seen(15.2) > 5);
    CHECK(seen(16.0) == 0);
    CHECK(seen(16.8) > seen(15.2) + 30);
    CHECK(seen(17.4) > seen(16.8));
    // It has the colour of its sphere, and the width of a line.
    const Colour colour = pixel(with, 592, 400);
    CHECK(colour.red > colour.blue + 20);
    int width = 0;
    for (int y = 0; y < 800; ++y)
      width += difference(pixel(with, 592, y), kDarkTheme.background) > 20;
    CHECK(width == 2);
  }
}

}  // namespace clatter
