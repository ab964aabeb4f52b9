#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/physics/random.h"
#include "tests/render/optional_context.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

View faded_view(double opacity) {
  View view = view_with_field();
  view.opacity = opacity;
  view.range = {ColourRange::Given, {0.0, 1.0}};
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  view.overlay = false;
  return view;
}

Snapshot without_particles(Snapshot snapshot) {
  snapshot.positions.conservativeResize(Eigen::NoChange, 0);
  snapshot.velocities.conservativeResize(Eigen::NoChange, 0);
  snapshot.angles.clear();
  snapshot.orientations.clear();
  snapshot.flights.clear();
  return snapshot;
}

/// Each particle moves into its place, over the whole exposure.
void blur(Snapshot& snapshot, double exposure) {
  snapshot.exposure = exposure;
  snapshot.flights.clear();
  const VecX still = VecX::Zero(snapshot.box.size());
  for (std::uint32_t i = 0; i < snapshot.count(); ++i) {
    const VecX velocity = snapshot.velocities.col(i);
    snapshot.flights.push_back(
        {i, -exposure, 0.0, snapshot.positions.col(i) - exposure * velocity, velocity, still});
  }
}

/// Spheres that hide each other, in a periodic box with a heatmap.
Snapshot crowded_spheres() {
  Snapshot snapshot;
  snapshot.box = Vec3(6.0, 5.0, 4.0);
  std::vector<Vec3> centres, velocities;
  Random random(7, Stream::Placement, 0, 0);
  for (int i = 0; i < 40; ++i) {
    const Vec3 share(random.uniform(), random.uniform(), random.uniform());
    centres.push_back(share.cwiseProduct(Vec3(snapshot.box)));
    velocities.push_back(share);
  }
  snapshot.positions = as_columns(centres);
  snapshot.velocities = as_columns(velocities);
  snapshot.orientations.assign(40, Eigen::Quaterniond::Identity());
  snapshot.field = FieldMap{Quantity::Density, {2, 1, 1}, {0.3, 0.9}};
  return snapshot;
}

/// sRGB of a mean of the light of two colours.
double mixed(std::uint8_t a, std::uint8_t b, double share) {
  const double c = (1.0 - share) * linear_light(a) + share * linear_light(b);
  return 255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

/// The largest deviation, in levels, of faded pictures from the mean of the pictures of all
/// particles and of none.
double off_mean(Renderer& renderer, const Gl& gl, const Snapshot& snapshot, Size size) {
  const View whole = faded_view(1.0);
  const Camera camera = renderer.fit(snapshot, size, whole, kText);
  const Image none = draw(renderer, gl, without_particles(snapshot), camera, size, whole);
  const Image all = draw(renderer, gl, snapshot, camera, size, whole);
  CHECK(difference(none, all) > 60);
  double off = 0.0;
  for (const double opacity : {0.0, 0.3, 0.5}) {
    const Image faded = draw(renderer, gl, snapshot, camera, size, faded_view(opacity));
    for (std::size_t i = 0; i < faded.rgba.size(); ++i) {
      if (i % 4 == 3) {
        REQUIRE(faded.rgba[i] == 255);
      } else {
        off = std::max(off, std::fabs(faded.rgba[i] - mixed(none.rgba[i], all.rgba[i], opacity)));
      }
    }
  }
  return off;
}

void check_means(const Gl& gl) {
  Snapshot disks = driven_box(), spheres = crowded_spheres();
  disks.angles.assign(disks.count(), 0.7);
  for (const int samples : {1, 2}) {
    CAPTURE(samples);
    Renderer renderer(gl, samples);
    for (const double exposure : {0.0, 0.5}) {
      CAPTURE(exposure);
      if (exposure > 0.0) blur(disks, exposure), blur(spheres, exposure);
      // In the smaller pictures particles have radii below 1.5 pixels.
      for (const Size size : {Size{320, 240}, {60, 45}})
        CHECK(off_mean(renderer, gl, disks, size) < 1.5);
      for (const Size size : {Size{320, 240}, {24, 18}})
        CHECK(off_mean(renderer, gl, spheres, size) < 1.5);
    }
    disks.exposure = spheres.exposure = 0.0;
  }
}

}  // namespace

TEST_CASE("Opacity: a faded picture is the weighted mean of those with and without particles") {
  check_means(open_context(Backend::Auto)->gl());
}

TEST_CASE("Opacity: it has the same meaning with OpenGL ES") {
  if (const auto context = open_es_context()) check_means(context->gl());
}

TEST_CASE("Opacity: spheres fade as one front surface, without those behind") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  Snapshot snapshot = crowded_spheres();
  snapshot.positions = as_columns<3>({{3.0, 2.5, 3.4}, {3.4, 2.5, 0.6}});
  snapshot.velocities = as_columns<3>({{0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  snapshot.orientations.clear();
  snapshot.field.reset();
  const View view = faded_view(0.5);
  const Camera camera{{3.0, 2.5}, 8.0, {.z = 2.0}};  // along z
  const auto overlap = [&] {
    return pixel(draw(renderer, context->gl(), snapshot, camera, {240, 180}, view), 126, 90);
  };
  const Colour both = overlap();
  snapshot.positions = as_columns<3>({{3.0, 2.5, 3.4}, {0.6, 2.5, 0.6}});
  CHECK(both == overlap());
}

TEST_CASE("Opacity: without a background it is the opacity of the particles' pixels") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = one_disk({5.0, 5.0}, 1.0);
  snapshot.box = Vec2(10.0, 10.0);
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  for (const int samples : {1, 2}) {
    Renderer renderer(context->gl(), samples, true);
    const auto drawn = [&](double opacity) {
      view.opacity = opacity;
      return with_own_colours(
          draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 12.0}, {300, 300}, view));
    };
    const Image whole = drawn(1.0), faded = drawn(0.4);
    int edges = 0;
    for (int y = 100; y < 200; ++y) {
      for (int x = 100; x < 200; ++x) {
        Colour seen = pixel(faded, x, y);
        const Colour full = pixel(whole, x, y);
        CHECK(std::fabs(seen.alpha - 0.4 * full.alpha) <= 1.0);
        if (seen.alpha < 32) continue;
        edges += full.alpha < 224;
        seen.alpha = full.alpha;
        CHECK(difference(seen, full) <= 4);
      }
    }
    CHECK(pixel(whole, 150, 150) == kDarkTheme.disk);
    CHECK(edges > 20);
  }
}

TEST_CASE("Opacity: trails and arrows do not fade") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  Snapshot snapshot = one_disk({120.0, 60.0}, 20.0);
  snapshot.flights = {{0, -1.0, 0.0, Vec2(40.0, 60.0), Vec2(80.0, 0.0), Vec2(0.0, 0.0)}};
  snapshot.arrows =
      ArrowMap{Quantity::Velocity, Vec2(40.0, 40.0), {{Vec2(30.0, 100.0), Vec2(1.0, 0.0)}}};
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  const auto drawn = [&](double opacity) {
    view.opacity = opacity;
    return draw(renderer, context->gl(), snapshot, kUnitProjection.camera, kUnitSize, view);
  };
  const Image plain = drawn(1.0);
  view.trails = 1.0;
  view.arrows = Quantity::Velocity;
  const Image all = drawn(1.0);
  for (const double opacity : {0.0, 0.5}) {
    const Image faded = drawn(opacity);
    int off = 0, shown = 0;
    for (int y = 0; y < kUnitSize.height; ++y) {
      for (int x = 0; x < 105; ++x) {  // left of the disk
        off = std::max(off, difference(pixel(faded, x, y), pixel(all, x, y)));
        shown += difference(pixel(faded, x, y), pixel(plain, x, y)) > 40;
      }
    }
    CHECK(off <= 1);
    CHECK(shown > 200);
    CHECK(difference(pixel(faded, 120, 53), pixel(all, 120, 53)) > 30);
  }
}

TEST_CASE("Opacity: hidden particles have no colour bar, unless trails have their colours") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Snapshot snapshot = driven_box();
  constexpr Size kSize{640, 360};
  View hidden = faded_view(0.0);
  hidden.overlay = true;
  View plain = hidden;
  plain.colour_by = ColourBy::None;
  const Camera camera = renderer.fit(snapshot, kSize, plain, kText);
  const auto bars_differ = [&] {
    return difference(draw(renderer, context->gl(), snapshot, camera, kSize, hidden),
                      draw(renderer, context->gl(), snapshot, camera, kSize, plain)) > 0;
  };
  CHECK_FALSE(bars_differ());
  CHECK(renderer.fit(snapshot, kSize, hidden, kText).width == camera.width);
  hidden.trails = plain.trails = 1.0;
  CHECK(bars_differ());
}

}  // namespace clatter
