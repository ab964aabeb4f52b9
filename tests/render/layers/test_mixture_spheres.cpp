// Spheres of different sizes in one picture.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/physics/random.h"
#include "render/layers/renderer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kMixtureSize{240, 180};

struct PlacedSphere {
  Vec3 centre;
  double radius;
  bool red = false;  // or blue
};

View red_and_blue() {
  View view;
  view.colour_by = ColourBy::VelocityX;
  view.range = {ColourRange::Given, {-1.0, 1.0}};
  view.overlay = false;
  return view;
}

// Spheres in a box whose edges are out of sight.
Snapshot unequal_spheres(const std::vector<PlacedSphere>& spheres) {
  Snapshot snapshot;
  snapshot.box = Vec3(200.0, 200.0, 200.0);
  snapshot.walls.fill(Wall{});
  snapshot.diameter = 0.0;
  std::vector<Vec3> centres, velocities;
  for (const auto& [centre, radius, red] : spheres) {
    snapshot.diameter = std::max(snapshot.diameter, 2.0 * radius);
    snapshot.grains.push_back({.radius = radius});
    centres.push_back(centre);
    velocities.emplace_back(red ? 1.0 : -1.0, 0.0, 0.0);
  }
  snapshot.positions = as_columns(centres);
  snapshot.velocities = as_columns(velocities);
  return snapshot;
}

// Without the sides of the box.
Image drawn_spheres(Snapshot snapshot, const Camera& camera, const View& view = red_and_blue()) {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), 1, true);
  const Canvas canvas(context->gl(), kMixtureSize);
  canvas.bind();
  renderer.draw(snapshot, camera, kMixtureSize, view, {});
  return canvas.read();
}

bool shows_red(Colour colour) {
  return colour.red > colour.blue + 10;
}
bool shows_blue(Colour colour) {
  return colour.blue > colour.red + 10;
}

// The covered area of the columns from `begin` to `end`, beyond that of the sides of the box.
double covered_area(const Image& image, const Image& empty, int begin = 0,
                    int end = kMixtureSize.width) {
  double sum = 0.0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = begin; x < end; ++x) {
      const double before = pixel(empty, x, y).alpha / 255.0;
      sum += (pixel(image, x, y).alpha / 255.0 - before) / (1.0 - before);
    }
  }
  return sum;
}

// Sides of walls are drawn, periodic ones are not.
Snapshot without_walls(Snapshot snapshot) {
  snapshot.walls.fill({});
  return snapshot;
}

Snapshot without_spheres(Snapshot snapshot) {
  snapshot.positions.conservativeResize(3, 0);
  snapshot.grains.clear();
  return snapshot;
}

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("Mixture spheres: each covers the area of its own radius") {
  // Seen from afar at 40 pixels a unit: radii of 60 and 16 pixels.
  const Snapshot snapshot =
      without_walls(unequal_spheres({{{98.5, 100.0, 100.0}, 1.5}, {{101.9, 100.1, 99.0}, 0.4}}));
  const Camera camera{{100.0, 100.0}, 6.0, {.z = 100.0}};
  const Image image = drawn_spheres(snapshot, camera);
  const Image empty = drawn_spheres(without_spheres(snapshot), camera);
  CHECK(covered_area(image, empty, 0, 160) == doctest::Approx(kPi * 60.0 * 60.0).epsilon(0.01));
  CHECK(covered_area(image, empty, 160) == doctest::Approx(kPi * 16.0 * 16.0).epsilon(0.01));
}

TEST_CASE("Mixture spheres: a small one before a large one is seen, and one behind is not") {
  const Camera camera{{100.0, 100.0}, 6.0, {.z = 100.0}};
  for (const double view_angle : {0.0, 50.0}) {
    Camera seen = camera;
    seen.orbit.view_angle = view_angle;
    for (const double z : {101.85, 98.15}) {
      const Image image = drawn_spheres(
          unequal_spheres({{{100.0, 100.0, 100.0}, 1.5, true}, {{100.0, 100.0, z}, 0.3}}), seen);
      CHECK((z > 100.0 ? shows_blue : shows_red)(pixel(image, 120, 90)));
      CHECK(shows_red(pixel(image, 150, 90)));
    }
  }
}

TEST_CASE("Mixture spheres: a small one past the horizon of a large one is behind it") {
  // The viewer is at 6 from the centre C of a sphere of radius 5. A sphere of radius 0.5 touches it
  // in a direction n with cos = 0.5 from that to the viewer: past the horizon at cos = 5/6. Its
  // centre is at sqrt(6^2 + 5.5^2 - 2 6 5.5 0.5) = 5.77 from the viewer, nearer than C.
  constexpr double kViewAngle = 130.0;
  const double distance = 6.0, width = 2.0 * distance * std::tan(0.5 * kViewAngle * kPi / 180.0);
  const Vec3 middle(100.0, 100.0, 100.0);
  const Vec3 small = middle + 5.5 * Vec3(std::sqrt(0.75), 0.0, 0.5);
  const Vec3 viewer = middle + Vec3(0.0, 0.0, distance);
  REQUIRE((small - viewer).norm() < distance);
  const Camera camera{{100.0, 100.0}, width, {.z = 100.0, .view_angle = kViewAngle}};
  const Image image = drawn_spheres(unequal_spheres({{middle, 5.0, true}, {small, 0.5}}), camera);
  const double scale = kMixtureSize.width / width;
  const auto column = [&](double tangent) { return 120.0 + scale * distance * tangent; };
  // The row through both centres: red up to the horizon, then a rest of the blue one.
  const double horizon = column(std::tan(std::asin(5.0 / distance)));
  const Vec3 away = small - viewer;
  const double centre_angle = std::atan2(away.x(), -away.z());
  const double end = column(std::tan(centre_angle + std::asin(0.5 / away.norm())));
  const double start = column(std::tan(centre_angle - std::asin(0.5 / away.norm())));
  REQUIRE(start < horizon - 3.0);
  REQUIRE(end > horizon + 3.0);
  for (int x = static_cast<int>(start); x < horizon - 1.5; ++x) {
    CHECK(shows_red(pixel(image, x, 89)));
  }
  for (int x = static_cast<int>(horizon + 1.5); x + 1.5 < end; ++x) {
    CHECK(shows_blue(pixel(image, x, 89)));
  }
}

namespace {

// Spheres of three sizes at random places without overlaps, in a room of 6 x 5 x 4.
Snapshot random_mixture() {
  std::vector<PlacedSphere> spheres;
  Random random(20240715, Stream::Placement, 0, 0);
  for (const auto& [count, radius] : {std::pair(4, 1.0), {20, 0.4}, {150, 0.12}}) {
    for (int placed = 0; placed < count;) {
      const Vec3 share(random.uniform(), random.uniform(), random.uniform());
      const Vec3 centre = Vec3(97.0, 97.5, 98.0) + share.cwiseProduct(Vec3(6.0, 5.0, 4.0));
      bool free = true;
      for (const PlacedSphere& other : spheres) {
        free = free && (other.centre - centre).norm() > other.radius + radius;
      }
      if (!free) continue;
      spheres.push_back({centre, radius, spheres.size() % 2 == 1});
      ++placed;
    }
  }
  return unequal_spheres(spheres);
}

}  // namespace

TEST_CASE("Mixture spheres: every pixel shows the first sphere on its ray") {
  // Pixels within two pixels of a silhouette do not count.
  const Snapshot snapshot = random_mixture();
  for (const double view_angle : {0.0, 40.0, 90.0}) {
    const Camera camera{{100.0, 100.0},
                        9.0,
                        {.z = 100.0, .azimuth = 30.0, .elevation = 25.0, .view_angle = view_angle}};
    const Image image = drawn_spheres(snapshot, camera);
    const Eye eye(Projection{camera, kMixtureSize});
    int seen = 0, wrong = 0;
    for (int y = 0; y < kMixtureSize.height; ++y) {
      for (int x = 0; x < kMixtureSize.width; ++x) {
        const Vec2 place =
            camera.width / kMixtureSize.width * Vec2(x + 0.5 - 120.0, 90.0 - y - 0.5);
        const Vec3 on_plane = eye.world({place.x(), place.y(), 0.0});
        const Vec3 towards = eye.axes().row(2);
        const Vec3 from = view_angle > 0.0 ? eye.viewer() : Vec3(on_plane + 50.0 * towards);
        const Vec3 along = (on_plane - from).normalized();
        double first = HUGE_VAL, clearance = HUGE_VAL;
        bool red = false;
        for (std::size_t i = 0; i < snapshot.count(); ++i) {
          const Vec3 away = Vec3(snapshot.positions.col(static_cast<Eigen::Index>(i))) - from;
          const double t = away.dot(along), off = (away - t * along).norm();
          const double radius = snapshot.grains[i].radius;
          if (t < 0.0) continue;
          clearance = std::min(clearance, std::fabs(off - radius));
          if (off >= radius) continue;
          const double entry = t - std::sqrt(radius * radius - off * off);
          if (entry >= first) continue;
          first = entry;
          red = i % 2 == 1;
        }
        if (first == HUGE_VAL || clearance < 2.0 * camera.width / kMixtureSize.width) continue;
        ++seen;
        if (!(red ? shows_red : shows_blue)(pixel(image, x, y))) ++wrong;
      }
    }
    CAPTURE(view_angle);
    CHECK(seen > 4000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("Mixture spheres: a plane of a slab cuts each at its own radius") {
  // A plane at 0.9 above the centre of a sphere of radius 1.5, and 0.3 above one of radius 0.5:
  // circles of radius 1.2 and 0.4, 40 pixels a unit. Below the slab nothing is drawn.
  const Snapshot snapshot =
      without_walls(unequal_spheres({{{98.5, 100.0, 100.0}, 1.5}, {{101.9, 100.1, 100.6}, 0.5}}));
  const Camera camera{{100.0, 100.0}, 6.0, {.z = 100.0}};
  View view = red_and_blue();
  view.slab = Slab{.axis = Axis::Z, .from = 100.9, .to = 110.0};
  const Image image = drawn_spheres(snapshot, camera, view);
  const Image empty = drawn_spheres(without_spheres(snapshot), camera, view);
  CHECK(covered_area(image, empty, 0, 160) == doctest::Approx(kPi * 48.0 * 48.0).epsilon(0.01));
  CHECK(covered_area(image, empty, 160) == doctest::Approx(kPi * 16.0 * 16.0).epsilon(0.02));
}

TEST_CASE("Mixture spheres: one without a shape shows its area before a large one") {
  // At 40 pixels a unit the small sphere has a radius of 0.8 pixels. Blue before red.
  const Camera camera{{100.0, 100.0}, 6.0, {.z = 100.0}};
  const auto drawn = [&](double z) {
    const auto context = open_context(Backend::Auto);
    Renderer renderer(context->gl());
    const Canvas canvas(context->gl(), kMixtureSize);
    canvas.bind();
    renderer.draw(unequal_spheres({{{100.0, 100.0, 100.0}, 1.5, true}, {{100.1, 100.1, z}, 0.02}}),
                  camera, kMixtureSize, red_and_blue(), {});
    return canvas.read();
  };
  const Image before = drawn(101.6), behind = drawn(98.0);
  const auto light = [&](const Image& image) {
    double sum = 0.0;
    for (int y = 80; y < 92; ++y) {
      for (int x = 118; x < 130; ++x) sum += linear_light(pixel(image, x, y).red);
    }
    return sum;
  };
  const double large = linear_light(pixel(behind, 124, 86).red);
  CHECK(shows_red(pixel(behind, 124, 86)));
  CHECK(pixel(before, 124, 86).blue > pixel(behind, 124, 86).blue);
  // It takes the red light of its area and gives some of its own.
  const double taken = (light(behind) - light(before)) / large;
  CHECK(taken > 0.85 * kPi * 0.8 * 0.8);
  CHECK(taken < 1.05 * kPi * 0.8 * 0.8);
}

TEST_CASE("Mixture spheres: those without a shape have the light of spheres seen from far away") {
  Snapshot snapshot = random_mixture();
  snapshot.positions =
      snapshot.positions * 8.0 - Vectors::Constant(3, snapshot.positions.cols(), 700.0);
  // The largest have a radius of 1.2 pixels.
  const Camera camera{{100.0, 100.0}, 200.0, {.z = 100.0, .azimuth = 30.0, .elevation = 25.0}};
  const auto light = [&](int samples) {
    const auto context = open_context(Backend::Auto);
    Renderer renderer(context->gl(), samples);
    View view = red_and_blue();
    view.background = Rgb{0, 0, 0};
    view.range = {ColourRange::Given, {-4.0, 4.0}};
    const auto sum = [&](const Snapshot& shown) {
      const Canvas canvas(context->gl(), kMixtureSize);
      canvas.bind();
      renderer.draw(shown, camera, kMixtureSize, view, {});
      const Image image = canvas.read();
      double total = 0.0;
      for (int y = 0; y < image.size.height; ++y) {
        for (int x = 0; x < image.size.width; ++x) {
          const Colour colour = pixel(image, x, y);
          total += linear_light(colour.red) + linear_light(colour.green);
        }
      }
      return total;
    };
    return sum(snapshot) - sum(without_spheres(snapshot));
  };
  CHECK(light(1) == doctest::Approx(light(12)).epsilon(0.06));
}

}  // namespace clatter
