// The time-stepped gas against collisions by hand.

#include <doctest/doctest.h>

#include <numeric>

#include "app/bench/time_stepped.h"
#include "engine/physics/walls.h"
#include "engine/run/scheduled_run.h"

namespace clatter {

namespace {

// Ten diameters wide, with two different walls.
Scene walled_scene() {
  Scene scene;
  scene.box = Vec2(10.0, 10.0);
  scene.particles.count = 2;
  scene.walls[kLeft] = Wall{.kind = WallKind::Driven, .restitution = 0.8, .drive_speed = 0.3};
  scene.walls[kRight] = Wall{.kind = WallKind::Static, .restitution = 0.6};
  return scene;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("Time-stepped gas: overlaps across every side of a cell are resolved") {
  const Scene scene = walled_scene();
  const auto collide = [&](const Vec2& first, const Vec2& second) {
    const Vec2 approach = 0.001 * (second - first);
    TimeStepped gas(scene, {{first, second}, {approach, -approach}}, 1e-3, 10);
    gas.run(1e-3);
    return gas.sums().collisions;
  };
  for (const int x : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      CAPTURE(x);
      CAPTURE(y);
      // From the middle of a cell toward each side of it, and within it.
      const Vec2 toward(x, y), middle(4.5, 4.5);
      const Vec2 second = x == 0 && y == 0 ? Vec2(4.7, 4.6) : Vec2(middle + 0.6 * toward);
      CHECK(collide(middle, second) == 1);
    }
  }
  CHECK(collide({5.0, 0.1}, {5.3, -0.2}) == 1);
  CHECK(collide({5.0, 4.5}, {6.1, 4.5}) == 0);
}

TEST_CASE("Time-stepped gas: a collision carries half of the exchanged energy over the contact") {
  Scene scene = walled_scene();
  scene.particles.restitution = 1.0;
  // The moving disk hits the resting one: energy 1/2 is carried from its centre to the other.
  TimeStepped gas(scene, {{{5.5, 5.0}, {4.6, 5.0}}, {{0.0, 0.0}, {1.0, 0.0}}}, 1e-3, 10);
  gas.run(1e-3);
  const SteppedSums& sums = gas.sums();
  CHECK(sums.collisions == 1);
  CHECK(sums.time == doctest::Approx(1e-3));
  CHECK(sums.deepest_overlap == doctest::Approx(0.101));
  CHECK(sums.dissipated == doctest::Approx(0.0));
  CHECK(sums.squares == doctest::Approx(1e-3));
  // Impulse 1 over one diameter, and the flight of the disk that moves.
  CHECK(sums.stress == doctest::Approx(-1.0 - 1e-3));
  CHECK(sum_of(sums.particles) == doctest::Approx(2e-3));
  CHECK(sums.particles[4] == doctest::Approx(1e-3));
  CHECK(sums.particles[5] == doctest::Approx(1e-3));
  // The line from 4.5505 to 5.5505, with half an energy unit per diameter.
  CHECK(sums.heat_carried[4] == doctest::Approx(0.5 * 0.4495));
  CHECK(sum_of(sums.heat_carried) == doctest::Approx(0.5 + 0.5e-3));
}

TEST_CASE("Time-stepped gas: each wall has its own restitution, and a driven one its speed") {
  const Scene scene = walled_scene();
  TimeStepped left(scene, {{{0.55, 5.0}, {5.0, 5.0}}, {{-1.0, 0.5}, {0.0, 0.0}}}, 0.1, 10);
  left.run(0.1);
  // theory 4.1: .8 + .3
  CHECK(left.sums().wall_impulse == doctest::Approx(2.1));
  CHECK(left.sums().squares == doctest::Approx(0.1 * (1.1 * 1.1 + 0.5 * 0.5)));
  CHECK(left.sums().stress == doctest::Approx(-0.5 * 2.1 - 0.1 * 1.1 * 1.1));
  TimeStepped right(scene, {{{9.45, 5.0}, {5.0, 5.0}}, {{1.0, 0.5}, {0.0, 0.0}}}, 0.1, 10);
  right.run(0.1);
  CHECK(right.sums().wall_impulse == doctest::Approx(1.6));
  CHECK(right.sums().squares == doctest::Approx(0.1 * (0.6 * 0.6 + 0.5 * 0.5)));
}

}  // namespace clatter
