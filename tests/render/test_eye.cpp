#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "render/camera_path.h"
#include "render/eye.h"

namespace clatter {

namespace {

constexpr Size kEyeSize{800, 600};

Projection projection(const Orbit& orbit, double width = 20.0) {
  return {{{1.0, 2.0}, width, orbit}, kEyeSize};
}

}  // namespace

TEST_CASE("Eye: from the front x is to the right, y up, and z to the viewer") {
  const Eye eye(projection({.z = 3.0}));
  CHECK((eye.seen({1.0, 2.0, 3.0})).norm() < 1e-12);
  CHECK((eye.seen({2.0, 4.0, 6.0}) - Vec3(1.0, 2.0, 3.0)).norm() < 1e-12);
  // 40 pixels a unit, from the middle of the picture; depths do not matter.
  CHECK((eye.pixels(eye.seen({2.0, 4.0, 9.0})) - Vec2(440.0, 380.0)).norm() < 1e-9);
}

TEST_CASE("Eye: angles turn the viewer about the y axis to x, and up") {
  // From +x one sees z to the left; from above z downwards.
  const Eye right(projection({.azimuth = 90.0}));
  CHECK((right.seen({1.0, 2.0, 1.0}) - Vec3(-1.0, 0.0, 0.0)).norm() < 1e-12);
  CHECK((right.seen({2.0, 2.0, 0.0}) - Vec3(0.0, 0.0, 1.0)).norm() < 1e-12);
  const Eye above(projection({.elevation = 90.0}));
  CHECK((above.seen({1.0, 2.0, 1.0}) - Vec3(0.0, -1.0, 0.0)).norm() < 1e-12);
  CHECK((above.seen({1.0, 3.0, 0.0}) - Vec3(0.0, 0.0, 1.0)).norm() < 1e-12);
  const Eye eye(projection({.z = 0.3, .azimuth = 37.0, .elevation = -22.0}));
  CHECK((eye.axes() * eye.axes().transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  const Vec3 right_axis = eye.axes().row(0), up = eye.axes().row(1), towards = eye.axes().row(2);
  CHECK((right_axis.cross(up) - towards).norm() < 1e-12);
  const Vec3 place(4.0, -1.0, 2.5);
  CHECK((eye.world(eye.seen(place)) - place).norm() < 1e-12);
}

TEST_CASE("Eye: nearer things are larger by the ratio of the distances") {
  // Half the width of 20 under 30 degrees: the viewer is at 10/tan(30 degrees) = 17.32.
  const double distance = 10.0 / std::tan(M_PI / 6.0);
  const Eye eye(projection({.z = 0.0, .view_angle = 60.0}));
  CHECK(1.0 / eye.inverse_distance() == doctest::Approx(distance));
  const double near = eye.pixels({3.0, 0.0, 5.0}).x() - 400.0;
  CHECK(near == doctest::Approx(40.0 * 3.0 * distance / (distance - 5.0)));
  // The edge of the picture is seen under 30 degrees at every depth.
  const double z = -30.0, x = (distance - z) * std::tan(M_PI / 6.0);
  CHECK(eye.pixels({x, 0.0, z}).x() == doctest::Approx(800.0));
}

TEST_CASE("Eye: the rectangle around a sphere touches its outline") {
  // All points of a sphere are inside of the rectangle, and some are at each of its sides. At 45
  // degrees off the axis the outline is an ellipse, wider than the radius by 1.4.
  for (const double view_angle : {0.0, 25.0, 100.0}) {
    CAPTURE(view_angle);
    const Eye eye(projection({.view_angle = view_angle}));
    for (const Vec3& seen : {Vec3(0.0, 0.0, 2.0), Vec3(-8.0, 5.0, -1.0), Vec3(9.0, -6.0, 3.0)}) {
      const auto [low, high] = eye.around(seen, 1.5);
      Vec2 least = Vec2::Constant(HUGE_VAL), most = Vec2::Constant(-HUGE_VAL);
      for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 800; ++j) {
          const double z = std::cos(M_PI * (i + 0.5) / 400.0), r = std::sqrt(1.0 - z * z);
          const double turn = 2.0 * M_PI * j / 800.0;
          const Vec3 point = seen + 1.5 * Vec3(r * std::cos(turn), r * std::sin(turn), z);
          least = least.cwiseMin(eye.pixels(point));
          most = most.cwiseMax(eye.pixels(point));
        }
      }
      CHECK(((least - low).array() > -1e-9).all());
      CHECK(((high - most).array() > -1e-9).all());
      CHECK((least - low).norm() + (high - most).norm() < 0.05);
    }
  }
}

TEST_CASE("Eye: a fitted camera shows all points, and one of them at the margin") {
  const std::array<Vec3, 4> points = {Vec3(0.0, 0.0, 0.0), Vec3(9.0, 1.0, 2.0),
                                      Vec3(3.0, 7.0, -4.0), Vec3(5.0, 5.0, 8.0)};
  const Margins margins{50.0, 130.0, 70.0, 20.0};
  for (const double view_angle : {0.0, 25.0, 90.0}) {
    CAPTURE(view_angle);
    const Orbit angles{.azimuth = 33.0, .elevation = 21.0, .view_angle = view_angle};
    const Camera camera = fit_orbit({4.0, 3.0, 1.0}, points, angles, kEyeSize, margins);
    const Eye eye(Projection{camera, kEyeSize});
    CHECK((eye.centre() - Vec3(4.0, 3.0, 1.0)).norm() < 1e-12);
    double room = HUGE_VAL;
    for (const Vec3& point : points) {
      const Vec2 pixel = eye.pixels(eye.seen(point));
      room = std::min(
          {room, pixel.x() - 50.0, 670.0 - pixel.x(), pixel.y() - 20.0, 530.0 - pixel.y()});
    }
    CHECK(std::fabs(room) < 1e-6);
  }
}

TEST_CASE("Camera path: spheres are seen from angles between those of the keys") {
  const Camera whole{{4.0, 3.0}, 40.0, {.z = 1.0, .azimuth = 30.0, .elevation = 20.0}};
  Snapshot snapshot;
  snapshot.time = 1.0;
  snapshot.positions = as_columns<3>({{1.0, 2.0, 3.0}});
  const std::vector<CameraKey> keys = {
      {.time = 0.0, .centre = {}, .follow = {}, .width = {}},
      {.time = 4.0, .centre = {}, .follow = 0, .width = {}, .azimuth = 390.0, .elevation = -40.0}};
  const Camera camera = camera_at(keys, snapshot, whole);
  const double e = 5.0 / 32.0;  // at a quarter of the time
  CHECK(camera.orbit.azimuth == doctest::Approx(30.0 + 360.0 * e));
  CHECK(camera.orbit.elevation == doctest::Approx(20.0 - 60.0 * e));
  CHECK(camera.orbit.z == doctest::Approx(1.0 + 2.0 * e));
  CHECK((camera.centre - Vec2(4.0 - 3.0 * e, 3.0 - 1.0 * e)).norm() < 1e-12);
}

}  // namespace clatter
