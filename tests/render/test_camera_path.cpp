#include <doctest/doctest.h>

#include "render/camera_path.h"

namespace clatter {

namespace {

const Camera kWhole{{10.0, 12.5}, 40.0};

Snapshot at(double time) {
  Snapshot snapshot;
  snapshot.time = time;
  snapshot.positions = as_columns<2>({{1.0, 2.0}, {3.0 + time, 4.0}});
  return snapshot;
}

void check(const Camera& camera, const Vec2& centre, double width) {
  CHECK((camera.centre - centre).norm() < 1e-12);
  CHECK(camera.width == doctest::Approx(width).epsilon(1e-12));
}

}  // namespace

TEST_CASE("Camera path: a camera's path passes its keys, and stays at its ends") {
  const std::vector<CameraKey> keys = {
      {.time = 2.0, .centre = {}, .follow = {}, .width = {}},
      {.time = 4.0, .centre = Vec2(2.0, 3.0), .follow = {}, .width = 10.0},
      {.time = 6.0, .centre = Vec2(6.0, 3.0), .follow = {}, .width = 10.0}};
  check(camera_at({}, at(3.0), kWhole), kWhole.centre, kWhole.width);
  for (const double time : {0.0, 2.0}) check(camera_at(keys, at(time), kWhole), {10.0, 12.5}, 40.0);
  check(camera_at(keys, at(4.0), kWhole), {2.0, 3.0}, 10.0);
  // Half way a width is the geometric mean; a quarter of the way e = 5/32.
  CHECK(camera_at(keys, at(3.0), kWhole).width == doctest::Approx(20.0));
  check(camera_at(keys, at(4.5), kWhole), {2.0 + 4.0 * 5.0 / 32.0, 3.0}, 10.0);
  for (const double time : {6.0, 9.0}) check(camera_at(keys, at(time), kWhole), {6.0, 3.0}, 10.0);
}

TEST_CASE("Camera path: a zoom keeps a point where it is on the picture") {
  const std::vector<CameraKey> keys = {
      {.time = 0.0, .centre = {}, .follow = {}, .width = {}},
      {.time = 1.0, .centre = Vec2(2.0, 3.0), .follow = {}, .width = 10.0}};
  // The fixed point of the zoom: (p - c_0) / w_0 = (p - c_1) / w_1.
  const Vec2 point = (40.0 * Vec2(2.0, 3.0) - 10.0 * kWhole.centre) / 30.0;
  const Vec2 place = (point - kWhole.centre) / 40.0;
  for (double time = 0.0; time <= 1.0; time += 0.125) {
    const Camera camera = camera_at(keys, at(time), kWhole);
    CHECK(((point - camera.centre) / camera.width - place).norm() < 1e-12);
  }
}

TEST_CASE("Camera path: a camera goes to a disk and follows it") {
  const std::vector<CameraKey> keys = {
      {.time = 0.0, .centre = Vec2(0.0, 0.0), .follow = {}, .width = 8.0},
      {.time = 2.0, .centre = {}, .follow = 1, .width = 8.0}};
  check(camera_at(keys, at(1.0), kWhole), {2.0, 2.0}, 8.0);  // half way to the present position
  check(camera_at(keys, at(2.0), kWhole), {5.0, 4.0}, 8.0);
  check(camera_at(keys, at(7.0), kWhole), {10.0, 4.0}, 8.0);
  const std::vector<CameraKey> nobody = {{.time = 0.0, .centre = {}, .follow = 5, .width = 3.0}};
  check(camera_at(nobody, at(0.0), kWhole), kWhole.centre, 3.0);
}

}  // namespace clatter
