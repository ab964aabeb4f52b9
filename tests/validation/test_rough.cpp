#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/physics/random.h"
#include "engine/physics/theory.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

// Rough particles of constant beta (infinite friction), q = 1/2, compared with (theory 6.9-6.11).
// The theory assumes independent Gaussian velocities and spins. The resulting error is a few
// percent in dilute, weakly inelastic gases (Luding, Huthmann, McNamara & Zippelius 1998).

namespace {

constexpr double kInertia = 0.5;

struct Pair {
  double restitution;
  double tangential_restitution;
};

Scene rough_gas(const Pair& pair) {
  Scene scene = gas_of_fraction(0.1, 100, pair.restitution);
  scene.particles.roughness = {std::numeric_limits<double>::infinity(),
                               pair.tangential_restitution};
  scene.particles.inertia = kInertia;
  return scene;
}

RoughGas theory(const Pair& pair) {
  return {pair.restitution, pair.tangential_restitution, kInertia};
}

// Spins of temperature T_rot = I <omega^2>, I = q/4.
State<2> spinning_start(const Scene& scene, double spin_temperature, std::uint64_t seed) {
  State<2> state = start_state<2>(scene, seed);
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    Random random(seed, Stream::Velocity, i, 1);
    state.spins.push_back(
        Spin<2>(std::sqrt(spin_temperature / (0.25 * kInertia)) * random.normal()));
  }
  return state;
}

}  // namespace

TEST_CASE("Rough gas: free cooling tends to one ratio of the temperatures, from both sides") {
  // phi = .1, N = 100, 32 seeds: half start without spin, half with T_rot = 3 T_tr. The ratio is
  // measured five times, from 40 to 60 collisions per particle. Then the slowest pair is within
  // e^-5 of its limit, and a box of this size has no clusters.
  constexpr int kSeeds = 32;
  for (const Pair& pair : {Pair{0.9, 0.0}, Pair{0.9, 0.5}, Pair{0.95, -0.5}, Pair{0.8, 0.9}}) {
    const Scene scene = rough_gas(pair);
    Sample ratios;
    for (std::uint64_t seed = 301; seed < 301 + kSeeds; ++seed) {
      Simulation<2> simulation(model_of<2>(scene, seed),
                               spinning_start(scene, seed % 2 ? 0.0 : 3.0, seed));
      double spin = 0.0, motion = 0.0;
      for (std::uint64_t collisions = 40; collisions <= 60; collisions += 5) {
        simulation.run_until(kNever, collisions * 50);
        const double scale = 1.0 / simulation.kinetic_energy();
        spin += 2.0 * simulation.spin_energy() * scale;
        motion += 1.0;
      }
      ratios.add(spin / motion);
    }
    const double expected = theory(pair).cooling_ratio();
    MESSAGE("alpha ", pair.restitution, ", beta ", pair.tangential_restitution,
            ": R = ", ratios.mean(), " +- ", ratios.standard_error(), ", theory ", expected);
    CHECK(ratios.standard_error() < 0.02 * expected);
    CHECK(std::fabs(ratios.mean() / expected - 1.0) < 0.05);
  }
}

TEST_CASE("Rough gas: kicks of the motion alone set both temperatures") {
  // H = s^2 (1 - 1/N)/dt = .099, and T is of order 1: a particle is kicked some ten times between
  // two collisions. T is predicted with Enskog's rate at phi = .1.
  std::uint64_t seed = 341;
  for (const Pair& pair : {Pair{0.9, 0.0}, Pair{0.8, 0.5}, Pair{0.9, -0.5}}) {
    Scene scene = rough_gas(pair);
    scene.bulk_drive = BulkDrive{.interval = 0.2, .kick_speed = std::sqrt(0.02)};
    const Measured result = run(scene, 100.0, 4000.0, seed++);
    const double power = bulk_drive_power(100.0, std::sqrt(0.02), 0.2);
    const double temperature = theory(pair).driven_temperature(0.1, power);
    const double ratio = theory(pair).driven_ratio();
    const Estimate& spin = *result.spin_temperature;
    MESSAGE("alpha ", pair.restitution, ", beta ", pair.tangential_restitution,
            ": T_tr = ", result.temperature.mean, " +- ", result.temperature.standard_error,
            ", theory ", temperature, "; R = ", spin.mean / result.temperature.mean, ", theory ",
            ratio);
    CHECK(relative_error(result.temperature) < 0.01);
    CHECK(std::fabs(relative(result.temperature, temperature)) < 0.05);
    CHECK(relative_error(spin) < 0.02);
    CHECK(std::fabs(spin.mean / result.temperature.mean / ratio - 1.0) < 0.05);
    MESSAGE("power = ", result.bulk_in->mean, " +- ", result.bulk_in->standard_error, ", expected ",
            100.0 * power);
    CHECK(relative_error(*result.bulk_in) < 0.015);
    CHECK(std::fabs(result.bulk_in->mean - 100.0 * power) < 5.0 * result.bulk_in->standard_error);
    check_energy_balance(result, 100);
  }
}

TEST_CASE("Driven gas: smooth particles have the temperature at which kicks balance the loss") {
  // beta = -1 in the theory of rough particles: A = (1 - alpha^2)/2, B = C = 0.
  Scene scene = gas_of_fraction(0.1, 100, 0.9);
  scene.bulk_drive = BulkDrive{.interval = 0.2, .kick_speed = std::sqrt(0.02)};
  const Measured result = run(scene, 100.0, 4000.0, 351);
  const double power = bulk_drive_power(100.0, std::sqrt(0.02), 0.2);
  const double expected = RoughGas{0.9, -1.0, kInertia}.driven_temperature(0.1, power);
  MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error, ", theory ",
          expected);
  CHECK(!result.spin_temperature);
  CHECK(relative_error(result.temperature) < 0.01);
  CHECK(std::fabs(relative(result.temperature, expected)) < 0.05);
  CHECK(std::fabs(result.bulk_in->mean - 100.0 * power) < 5.0 * result.bulk_in->standard_error);
  check_energy_balance(result, 100);
}
