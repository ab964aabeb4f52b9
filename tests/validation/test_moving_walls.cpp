#include <doctest/doctest.h>

#include <cmath>

#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kStroke = 0.01;

// The standard gas between saw-tooth walls of this stroke. Their gain (1 + alpha_w) stroke
// frequency is v_dr = 1 (theory 4.4).
Scene sawtooth_gas(double restitution, double wall_restitution) {
  Scene scene = vibrated_gas(restitution, wall_restitution);
  const Wall wall{.kind = WallKind::Sawtooth,
                  .restitution = wall_restitution,
                  .stroke = kStroke,
                  .frequency = 1.0 / ((1.0 + wall_restitution) * kStroke)};
  wall_in(scene, 0, wall);
  return scene;
}

// T between saw-tooth walls and between driven walls, their limit, each to `precision`.
void compare_with_limit(double restitution, double wall_restitution, double start_temperature,
                        double duration, std::uint64_t seed, double precision, double width) {
  Scene limit = vibrated_gas(restitution, wall_restitution);
  Scene finite = sawtooth_gas(restitution, wall_restitution);
  limit.particles.start.temperature = finite.particles.start.temperature = start_temperature;
  const Measured driven = run(limit, 300.0, duration, seed);
  const Measured moved = run(finite, 300.0, duration, seed + 1);
  MESSAGE("T = ", moved.temperature.mean, " +- ", moved.temperature.standard_error,
          " at a stroke of .01, ", driven.temperature.mean, " +- ",
          driven.temperature.standard_error, " in the limit");
  CHECK(relative_error(driven.temperature) < precision);
  CHECK(relative_error(moved.temperature) < precision);
  CHECK(std::fabs(relative(moved.temperature, driven.temperature.mean)) < width);
  check_energy_balance(moved, 100);
}

}  // namespace

TEST_CASE("Moving walls: a short saw-tooth heats like the driven wall, within 3 %") {
  compare_with_limit(0.9, 1.0, 0.7, 5000.0, 601, 0.01, 0.03);
  compare_with_limit(0.9, 0.9, 0.6, 5000.0, 603, 0.01, 0.03);
}

TEST_CASE("Moving walls: a short saw-tooth heats like the driven wall, within 1 %" *
          doctest::test_suite("slow")) {
  compare_with_limit(0.9, 1.0, 0.7, 100000.0, 605, 0.003, 0.01);
  compare_with_limit(0.9, 0.9, 0.6, 100000.0, 607, 0.003, 0.01);
}

TEST_CASE("Moving walls: sinusoidal walls give the energy that collisions dissipate") {
  Scene scene = vibrated_gas(0.9, 0.95);
  wall_in(scene, 0,
          {.kind = WallKind::Sinusoidal, .restitution = 0.95, .stroke = 0.5, .frequency = 0.7});
  const Measured result = run(scene, 300.0, 4000.0, 609);
  CHECK(relative_error(*result.walls_in) < 0.03);
  CHECK(result.dissipated.mean > 1.0);
  check_energy_balance(result, 100);
}

TEST_CASE("Moving walls: a shaken floor carries the weight of a rough, kicked gas") {
  // All sources and sinks of energy at once. Gravity contributes zero on average. t_c prevents a
  // collapse of particles onto the receding floor.
  Scene scene = gas(12.0, 30.0, 40, 0.9);
  scene.walls[kBottom] = {.kind = WallKind::Sinusoidal,
                          .restitution = 0.9,
                          .roughness = {0.3, 0.5},
                          .stroke = 0.4,
                          .frequency = 1.0};
  scene.walls[kTop] = Wall{};
  scene.particles.roughness = {0.5, 0.5};
  scene.gravity = Vec2(0.0, -0.5);
  scene.bulk_drive = BulkDrive{.interval = 0.5, .kick_speed = 0.1, .kick_spin = 0.1};
  scene.contact_time = 1e-4;
  const Measured result = run(scene, 300.0, 4000.0, 611);
  MESSAGE("walls ", result.walls_in->mean, ", kicks ", result.bulk_in->mean, ", gravity ",
          result.gravity_in->mean, ", dissipated ", result.dissipated.mean);
  CHECK(result.walls_in->mean > 10.0 * result.walls_in->standard_error);
  CHECK(result.bulk_in->mean > 10.0 * result.bulk_in->standard_error);
  check_energy_balance(result, 40);
  // The floor carries the weight plus the force on the lid.
  const Estimate &floor = *result.pressure[kBottom], &lid = *result.pressure[kTop];
  const double weight = 40.0 * 0.5 / 12.0;
  CHECK(std::fabs(floor.mean - lid.mean - weight) <
        5.0 * std::hypot(floor.standard_error, lid.standard_error));
}
