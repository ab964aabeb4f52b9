// The time-stepped gas against collisions by hand.

#include <doctest/doctest.h>

#include <numeric>

#include "app/bench/run_result.h"
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

TEST_CASE("Time-stepped gas: its results are the sums per time and area") {
  Scene scene = walled_scene();
  scene.box = Vec2(10.0, 8.0);
  scene.particles.count = 20;
  scene.particles.restitution = 0.9;
  scene.measure.cells = {30, 1};
  const RunResult found = observe_stepped(scene, 0.01, {.burn_in = 5.0, .duration = 20.0}, 3);

  const auto exact = simulation_of<2>(scene, 3);
  exact->run_until(5.0);
  TimeStepped gas(scene, exact->state(), 0.01, 30);
  gas.run(4.0);
  gas.restart_sums();
  gas.run(20.0);
  const SteppedSums& sums = gas.sums();
  const auto collisions = static_cast<double>(sums.collisions);
  CHECK(found.time == doctest::Approx(20.0));
  CHECK(found.cpu_seconds > 0.0);
  CHECK(found.cpu_seconds < 10.0);
  CHECK(found.events == collisions);
  CHECK(found.bytes == gas.bytes());
  CHECK(found.collision_rate == doctest::Approx(2.0 * collisions / 20.0 / 20.0));
  CHECK(found.deepest_overlap == sums.deepest_overlap);
  CHECK(found.means[kTemperature] == doctest::Approx(sums.squares / 2.0 / 20.0 / 20.0));
  CHECK(found.means[kPressure] == doctest::Approx(sums.wall_impulse / 16.0 / 20.0));
  CHECK(found.means[kStress] == doctest::Approx(sums.stress / 80.0 / 20.0));
  CHECK(found.means[kDissipation] == doctest::Approx(-sums.dissipated / 80.0 / 20.0));
  for (std::size_t k = 0; k < 60; ++k) {
    const double column = 80.0 / 30.0 * 20.0;
    CHECK(found.density[k] == doctest::Approx(sums.particles[k / 2] / column));
    CHECK(found.heat_flux[k] == doctest::Approx(sums.heat_carried[k / 2] / column));
  }
}

}  // namespace clatter
