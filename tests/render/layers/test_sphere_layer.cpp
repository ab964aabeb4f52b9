#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "engine/physics/random.h"
#include "render/layers/renderer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kSphereSize{240, 180};
constexpr double kRadius = 0.5;

View plain_view() {
  View view;
  view.colour_by = ColourBy::VelocityX;
  view.range = {ColourRange::Given, {-1.0, 1.0}};
  view.overlay = false;
  return view;
}

/// Spheres at random places without overlaps in 6 x 5 x 4, in the middle of a much larger box,
/// whose edges are out of the way.
Snapshot random_spheres(int count) {
  Snapshot snapshot;
  const Vec3 room(6.0, 5.0, 4.0), corner(20.0, 20.0, 20.0);
  snapshot.box = room + 2.0 * corner;
  snapshot.walls.fill(Wall{});
  std::vector<Vec3> centres, velocities;
  Random random(20240612, Stream::Placement, 0, 0);
  while (static_cast<int>(centres.size()) < count) {
    const Vec3 share(random.uniform(), random.uniform(), random.uniform());
    const Vec3 centre = corner + share.cwiseProduct(room);
    bool free = true;
    for (const Vec3& other : centres) free = free && (other - centre).norm() > 1.0;
    if (!free) continue;
    velocities.emplace_back(centres.size() % 2 ? 1.0 : -1.0, 0.0, 0.0);
    centres.push_back(centre);
  }
  snapshot.positions = as_columns(centres);
  snapshot.velocities = as_columns(velocities);
  return snapshot;
}

Image draw(const Snapshot& snapshot, const Camera& camera, const View& view) {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Canvas canvas(context->gl(), kSphereSize);
  canvas.bind();
  renderer.draw(snapshot, camera, kSphereSize, view, {});
  return canvas.read();
}

/// A ray of a pixel, in world coordinates, from the definition of the camera.
struct Ray {
  Vec3 origin, direction;
};

Ray ray_of(const Camera& camera, double x, double y) {
  const Eye eye(Projection{camera, kSphereSize});
  const double unit = camera.width / kSphereSize.width;
  const Vec3 right = eye.axes().row(0), up = eye.axes().row(1), towards = eye.axes().row(2);
  const Vec3 place = eye.centre() + unit * (x - 0.5 * kSphereSize.width) * right +
                     unit * (y - 0.5 * kSphereSize.height) * up;
  if (camera.orbit.view_angle == 0.0) return {place + 100.0 * towards, -towards};
  const double distance =
      0.5 * camera.width / std::tan(0.5 * camera.orbit.view_angle * M_PI / 180.0);
  const Vec3 viewer = eye.centre() + distance * towards;
  return {viewer, (place - viewer).normalized()};
}

struct Hit {
  std::size_t sphere;
  double clearance;  // from the silhouettes of all spheres, world units
};

/// The first sphere on a ray.
std::optional<Hit> first_hit(const Snapshot& snapshot, const Ray& ray, double& clearance) {
  std::optional<Hit> hit;
  double first = HUGE_VAL;
  clearance = HUGE_VAL;
  for (std::size_t i = 0; i < snapshot.count(); ++i) {
    const Vec3 away = Vec3(snapshot.positions.col(static_cast<Eigen::Index>(i))) - ray.origin;
    const double along = away.dot(ray.direction);
    const double off = (away - along * ray.direction).norm();
    clearance = std::min(clearance, std::fabs(off - kRadius));
    if (off >= kRadius) continue;
    const double t = along - std::sqrt(kRadius * kRadius - off * off);
    if (t < first) {
      first = t;
      hit = {i, clearance};
    }
  }
  return hit;
}

bool is_red(Colour colour) {
  return colour.red > colour.blue + 10;
}
bool is_blue(Colour colour) {
  return colour.blue > colour.red + 10;
}

}  // namespace

TEST_CASE("Sphere layer: every pixel shows the first sphere on its ray") {
  // Red and blue spheres. Pixels within two pixels of any silhouette do not count. All others on a
  // sphere have its colour.
  const Snapshot snapshot = random_spheres(50);
  for (const double view_angle : {0.0, 40.0, 90.0}) {
    const Camera camera{{23.0, 22.5},
                        9.0,
                        {.z = 22.0, .azimuth = 30.0, .elevation = 25.0, .view_angle = view_angle}};
    const Image image = draw(snapshot, camera, plain_view());
    int spheres = 0, wrong = 0;
    for (int y = 0; y < kSphereSize.height; ++y) {
      for (int x = 0; x < kSphereSize.width; ++x) {
        double clearance = 0.0;
        const auto hit =
            first_hit(snapshot, ray_of(camera, x + 0.5, kSphereSize.height - y - 0.5), clearance);
        if (!hit || clearance < 2.0 * camera.width / kSphereSize.width) continue;
        ++spheres;
        const Colour colour = pixel(image, x, y);
        if (hit->sphere % 2 ? !is_red(colour) : !is_blue(colour)) ++wrong;
      }
    }
    CAPTURE(view_angle);
    CHECK(spheres > 4000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("Sphere layer: a sphere is drawn where it is and as large as it is") {
  // A radius of 20 pixels, seen along the row through the centre.
  Snapshot snapshot;
  snapshot.box = Vec3(4.0, 4.0, 4.0);
  snapshot.positions = as_columns<3>({{2.03, 1.96, 2.0}});
  snapshot.velocities = as_columns<3>({{0.0, 0.0, 0.0}});
  const Camera camera{{2.0, 2.0}, 6.0, {.z = 2.0}};  // 40 pixels a unit
  View view = plain_view();
  view.background = Rgb{0, 0, 0};
  const Image image = draw(snapshot, camera, view);
  const Colour middle = pixel(image, 121, 88);
  double left = 1e9, right = 0.0;
  // Between the edges of the box.
  for (int x = 60; x < 180; ++x) {
    const double light = linear_light(pixel(image, x, 88).green);
    if (light > 0.001 && pixel(image, x, 88).green > 8) {
      left = std::min(left, static_cast<double>(x));
      right = std::max(right, x + 1.0);
    }
  }
  CHECK(linear_light(middle.green) > 0.2);
  // 121.2 +- 20, with soft edges of a pixel.
  CHECK(std::fabs(left - 101.2) < 1.3);
  CHECK(std::fabs(right - 141.2) < 1.3);
}

TEST_CASE("Sphere layer: the edge of a sphere blends with the sphere behind it") {
  // Two spheres of one colour, one behind the other and to the right: along the row through both
  // centres no pixel between them is as dark as the background would make it.
  Snapshot snapshot;
  snapshot.box = Vec3(4.0, 4.0, 4.0);
  snapshot.positions = as_columns<3>({{1.7125, 2.0, 3.0}, {2.2, 2.0, 1.5}});
  snapshot.velocities = as_columns<3>({{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  const Camera camera{{2.0, 2.0}, 6.0, {.z = 2.0}};  // 40 pixels a unit
  View view = plain_view();
  view.background = Rgb{0, 0, 0};
  const Image image = draw(snapshot, camera, view);
  // The silhouette of the first is at 120 + 40 (1.7125 + 0.5 - 2) = 128.5.
  const int inside = pixel(image, 124, 89).red, behind = pixel(image, 132, 89).red;
  CHECK(inside > 60);
  CHECK(behind > 60);
  for (int x = 124; x <= 132; ++x) CHECK(pixel(image, x, 89).red > 0.7 * std::min(inside, behind));
}

TEST_CASE("Sphere layer: a slab hides what lies outside of it, and cuts spheres flat") {
  Snapshot snapshot;
  snapshot.box = Vec3(4.0, 4.0, 4.0);
  snapshot.walls.fill(Wall{});
  // Blue in front of red; the plane z = 2 cuts the red one through its middle.
  snapshot.positions = as_columns<3>({{2.0, 2.0, 3.4}, {2.0, 2.0, 2.0}});
  snapshot.velocities = as_columns<3>({{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  const Camera camera{{2.0, 2.0}, 6.0, {.z = 2.0}};
  View view = plain_view();
  CHECK(is_blue(pixel(draw(snapshot, camera, view), 120, 90)));
  view.slab = Slab{Axis::Z, 0.0, 2.0};
  const Image cut = draw(snapshot, camera, view);
  CHECK(is_red(pixel(cut, 120, 90)));
  CHECK(pixel(cut, 120, 90) == pixel(cut, 128, 84));  // flat: one shade
}

TEST_CASE("Sphere layer: images at a periodic border are faint outside of the box") {
  Snapshot snapshot;
  snapshot.box = Vec3(4.0, 4.0, 4.0);
  snapshot.positions = as_columns<3>({{0.0, 2.0, 2.0}});
  snapshot.velocities = as_columns<3>({{1.0, 0.0, 0.0}});
  const Camera camera{{2.0, 2.0}, 6.0, {.z = 2.0}};  // the box is from pixel 40 to 200
  const Image image = draw(snapshot, camera, plain_view());
  // Half of the sphere at either end; between them nothing.
  for (const auto& [inside, outside] : {std::pair(50, 30), {190, 210}}) {
    CHECK(is_red(pixel(image, inside, 90)));
    const int faint = difference(pixel(image, outside, 90), kDarkTheme.background);
    CHECK(faint > 5);
    CHECK(faint < difference(pixel(image, inside, 90), kDarkTheme.background) / 2);
  }
  CHECK(pixel(image, 120, 90) == kDarkTheme.background);
}

namespace {

/// The sum over the pixels of the linear light above a black background.
double light_of_picture(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const Colour colour = pixel(image, x, y);
      sum += linear_light(colour.red) + linear_light(colour.green) + linear_light(colour.blue);
    }
  }
  return sum;
}

View black_view() {
  View view = plain_view();
  view.background = Rgb{0, 0, 0};
  view.range = {ColourRange::Given, {-4.0, 4.0}};  // pale: no channel reaches its end
  return view;
}

}  // namespace

TEST_CASE("Small spheres: they have the light of spheres with a shape, seen from far away") {
  const auto context = open_context(Backend::Auto);
  Snapshot snapshot = random_spheres(30);
  snapshot.box *= 2.0;
  snapshot.positions *= 2.0;  // too far from each other for the shade of neighbours
  // Radii of 0.9 and 1.4 pixels. With eight samples per pixel the spheres have shapes.
  for (const double width : {133.0, 86.0}) {
    const Camera camera{{46.0, 45.0}, width, {.z = 44.0, .azimuth = 30.0, .elevation = 25.0}};
    const auto picture = [&](int samples) {
      Renderer renderer(context->gl(), samples);
      const Canvas canvas(context->gl(), kSphereSize);
      canvas.bind();
      Snapshot without = snapshot;
      without.positions.conservativeResize(3, 0);
      renderer.draw(without, camera, kSphereSize, black_view(), {});
      const double box = light_of_picture(canvas.read());
      renderer.draw(snapshot, camera, kSphereSize, black_view(), {});
      return light_of_picture(canvas.read()) - box;
    };
    CAPTURE(width);
    CHECK(picture(1) == doctest::Approx(picture(8)).epsilon(0.03));
  }
}

TEST_CASE("Small spheres: the first one on a ray hides those behind it") {
  Snapshot snapshot;
  snapshot.box = Vec3(100.0, 100.0, 100.0);
  // Blue in front, or red in front, seen along z at 2.4 pixels a unit, in the middle of a pixel.
  const double middle = 50.0 + 0.5 / 2.4;
  for (const double blue : {70.0, 30.0}) {
    snapshot.positions = as_columns<3>({{middle, middle, blue}, {middle, middle, 50.0}});
    snapshot.velocities = as_columns<3>({{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
    const Camera camera{{50.0, 50.0}, 100.0, {.z = 50.0}};
    const Image image = draw(snapshot, camera, plain_view());
    CHECK((blue > 50.0 ? is_blue : is_red)(pixel(image, 120, 89)));
  }
}

TEST_CASE("Small spheres: a slice hides those behind it") {
  Snapshot snapshot;
  snapshot.box = Vec3(100.0, 100.0, 100.0);
  snapshot.velocities = as_columns<3>({{1.0, 0.0, 0.0}});
  snapshot.field = FieldMap{Quantity::Density, {1, 1, 1}, {0.5}};
  View view = plain_view();
  view.field = Quantity::Density;
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  for (const double view_angle : {0.0, 40.0}) {
    const Camera camera{{50.0, 50.0}, 120.0, {.z = 50.0, .view_angle = view_angle}};
    const auto change = [&](double z) {
      snapshot.positions = as_columns<3>({{50.2, 50.2, z}});
      Snapshot without = snapshot;
      without.positions = as_columns<3>({{50.2, 50.2, 20.0}});
      return difference(draw(snapshot, camera, view), draw(without, camera, view));
    };
    CHECK(change(30.0) == 0);
    CHECK(change(70.0) > 20);
  }
}

TEST_CASE("Sphere layer: the marks of a sphere are where its rotation has moved them") {
  // A spot at the front of the sphere, seen along z, turns about an axis of the picture.
  Snapshot snapshot;
  snapshot.box = Vec3(4.0, 4.0, 4.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions = as_columns<3>({{2.0, 2.0, 2.0}});
  snapshot.velocities = as_columns<3>({{1.0, 0.0, 0.0}});
  const Camera camera{{2.0, 2.0}, 1.2, {.z = 2.0}};  // a radius of 100 pixels
  const Image unmarked = draw(snapshot, camera, black_view());
  for (const Vec3& axis : {Vec3(0.0, 1.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.6, -0.8, 0.0)}) {
    for (const double angle : {0.0, 0.3, -0.4}) {
      snapshot.orientations = {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis))};
      const Image image = draw(snapshot, camera, black_view());
      // The centroid of the darkened pixels near the middle of the picture.
      Vec2 sum(0.0, 0.0);
      double dark = 0.0;
      for (int y = 20; y < 160; ++y) {
        for (int x = 50; x < 190; ++x) {
          const Vec2 place(x + 0.5 - 120.0, 90.0 - y - 0.5);
          if (place.norm() > 66.0) continue;
          const double before = linear_light(pixel(unmarked, x, y).red);
          const double share = 1.0 - linear_light(pixel(image, x, y).red) / before;
          if (share < 0.1) continue;
          sum += share * place;
          dark += share;
        }
      }
      const Vec3 turned = Eigen::AngleAxisd(angle, axis) * Vec3(0.0, 0.0, 1.0);
      CAPTURE(angle);
      REQUIRE(dark > 1000.0);
      // The centroid of the projection of a cap is its axis times the cosine of its edge.
      CHECK((sum / dark - 0.955 * 100.0 * turned.head<2>()).norm() < 0.6);
    }
  }
}

namespace {

/// The sum of the light, and the mean and the variance of its columns, around a sphere.
Eigen::Vector3d spread(const Image& image, const Image& empty) {
  Eigen::Vector3d sums(0.0, 0.0, 0.0);
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const double light =
          linear_light(pixel(image, x, y).green) - linear_light(pixel(empty, x, y).green);
      sums += light * Eigen::Vector3d(1.0, x + 0.5, (x + 0.5) * (x + 0.5));
    }
  }
  const double mean = sums[1] / sums[0];
  return {sums[0], mean, sums[2] / sums[0] - mean * mean};
}

}  // namespace

TEST_CASE("Renderer: motion blur of a sphere has the centroid and the width of its path") {
  // Moves 1.5 diameters to the right during the exposure, seen at 40 pixels a unit.
  Snapshot snapshot;
  snapshot.box = Vec3(8.0, 8.0, 8.0);
  snapshot.walls.fill(Wall{});
  snapshot.positions = as_columns<3>({{4.7, 4.1, 4.0}});
  snapshot.velocities = as_columns<3>({{3.0, 0.0, 0.0}});
  const Camera camera{{4.0, 4.0}, 6.0, {.z = 4.0}};
  Snapshot none = snapshot;
  none.positions.conservativeResize(3, 0);
  const Image empty = draw(none, camera, black_view());
  const Eigen::Vector3d sharp = spread(draw(snapshot, camera, black_view()), empty);
  const auto blurred_by = [&](double way) {
    snapshot.exposure = 0.5;
    // A collision in the middle of the exposure does not change the velocity.
    const Vec3 velocity(way / 0.5, 0.0, 0.0), end = snapshot.positions.col(0);
    snapshot.flights = {{0, -0.9, -0.25, end - 0.9 * velocity, velocity, Vec3::Zero()},
                        {0, -0.25, 0.0, end - 0.25 * velocity, velocity, Vec3::Zero()}};
    return spread(draw(snapshot, camera, black_view()), empty);
  };
  const Eigen::Vector3d blurred = blurred_by(1.5);
  CHECK(blurred[0] == doctest::Approx(sharp[0]).epsilon(0.02));
  CHECK(std::fabs(blurred[1] - (sharp[1] - 30.0)) < 0.3);
  CHECK(blurred[2] == doctest::Approx(sharp[2] + 60.0 * 60.0 / 12.0).epsilon(0.02));
  // A sphere at rest looks as without an exposure.
  blurred_by(0.0);
  const Image resting = draw(snapshot, camera, black_view());
  snapshot.exposure = 0.0;
  CHECK(difference(draw(snapshot, camera, black_view()), resting) <= 1);
}

}  // namespace clatter
