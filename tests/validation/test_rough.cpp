#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/physics/random.h"
#include "engine/physics/spin.h"
#include "engine/physics/theory.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

// Rough particles of constant beta (infinite friction), q = 1/2 for disks and 2/5 for spheres,
// compared with (theory 6.9-6.11). The theory assumes independent Gaussian velocities and spins.
// The resulting error is a few percent in dilute, weakly inelastic gases (Luding, Huthmann,
// McNamara & Zippelius 1998).

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

struct Pair {
  double restitution;
  double tangential_restitution;
};

// phi = .1, N = 100.
Scene rough_gas(const Pair& pair, int dimension) {
  Scene scene = gas_of_fraction(0.1, 100, pair.restitution, dimension);
  scene.particles.roughness = {kUnlimited, pair.tangential_restitution};
  return scene;
}

RoughGas theory(const Scene& scene) {
  return {scene.particles.restitution, scene.particles.roughness.tangential_restitution_in_force(),
          scene.particles.inertia, scene.dimension()};
}

// Spins of temperature T_rot = I <omega^2> per component, I = q/4.
template <int D>
State<D> spinning_start(const Scene& scene, double spin_temperature, std::uint64_t seed) {
  State<D> state = start_state<D>(scene, seed);
  state.spins.clear();
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    Random random(seed, Stream::Velocity, i, 1);
    Spin<D>& spin = state.spins.emplace_back();
    for (double& component : spin) {
      component = std::sqrt(spin_temperature / (0.25 * scene.particles.inertia)) * random.normal();
    }
  }
  return state;
}

// T_rot/T of the current state.
template <int D>
double temperature_ratio(const Simulation<D>& simulation) {
  return (simulation.spin_energy() / kSpinSize<D>) / (simulation.kinetic_energy() / D);
}

// 64 seeds: half start without spin, half with T_rot = 3 T_tr. The ratio is measured five times
// over 20 collisions per particle, after the given number of them. Then the slowest pair is within
// e^-6 of its limit, and a box of this size has no clusters.
template <int D>
void check_cooling(const std::vector<Pair>& pairs, std::uint64_t first) {
  constexpr int kSeeds = 64;
  for (const Pair& pair : pairs) {
    const Scene scene = rough_gas(pair, D);
    Sample ratios;
    for (std::uint64_t seed = 301; seed < 301 + kSeeds; ++seed) {
      Simulation<D> simulation(model_of<D>(scene, seed),
                               spinning_start<D>(scene, seed % 2 ? 0.0 : 3.0, seed));
      double sum = 0.0;
      for (std::uint64_t collisions = first; collisions <= first + 20; collisions += 5) {
        simulation.run_until(kNever, collisions * 50);
        sum += temperature_ratio(simulation);
      }
      ratios.add(sum / 5.0);
    }
    const double expected = theory(scene).cooling_ratio();
    MESSAGE(D, "D, alpha ", pair.restitution, ", beta ", pair.tangential_restitution,
            ": R = ", ratios.mean(), " +- ", ratios.standard_error(), ", theory ", expected);
    CHECK(ratios.standard_error() < 0.02 * expected);
    CHECK(std::fabs(ratios.mean() / expected - 1.0) < 0.05);
  }
}

// H = (D/2) s^2 (1 - 1/N)/dt, s^2/dt = .1, and T is of order 1: a particle is kicked some ten times
// between two collisions. T is predicted with Enskog's rate at phi = .1.
void check_kicked(const Pair& pair, int dimension, double duration, std::uint64_t seed) {
  Scene scene = rough_gas(pair, dimension);
  scene.bulk_drive = BulkDrive{.interval = 0.2, .kick_speed = std::sqrt(0.02)};
  const Measured result = run(scene, 100.0, duration, seed);
  const double power = 0.5 * dimension * 0.02 * (1.0 - 1.0 / 100.0) / 0.2;
  const double temperature = theory(scene).driven_temperature(0.1, power);
  const double ratio = theory(scene).driven_ratio();
  const Estimate& spin = *result.spin_temperature;
  const double measured_ratio = spin.mean / result.temperature.mean;
  // The two errors are correlated positively, so their quadratic sum is an upper bound.
  MESSAGE(dimension, "D, alpha ", pair.restitution, ", beta ", pair.tangential_restitution,
          ": T_tr = ", result.temperature.mean, " +- ", result.temperature.standard_error,
          ", theory ", temperature, "; R = ", measured_ratio, " +- ",
          measured_ratio * std::hypot(relative_error(spin), relative_error(result.temperature)),
          ", theory ", ratio);
  CHECK(relative_error(result.temperature) < 0.01);
  CHECK(std::fabs(relative(result.temperature, temperature)) < 0.05);
  CHECK(relative_error(spin) < 0.02);
  CHECK(std::fabs(measured_ratio / ratio - 1.0) < 0.05);
  MESSAGE("power = ", result.bulk_in->mean, " +- ", result.bulk_in->standard_error, ", expected ",
          100.0 * power);
  CHECK(relative_error(*result.bulk_in) < 0.015);
  CHECK(std::fabs(result.bulk_in->mean - 100.0 * power) < 5.0 * result.bulk_in->standard_error);
  check_energy_balance(result, 100);
}

}  // namespace

TEST_CASE("Rough gas: free cooling tends to one ratio of the temperatures, from both sides") {
  check_cooling<2>({{0.9, 0.0}, {0.9, 0.5}, {0.95, -0.5}, {0.8, 0.9}}, 40);
}

TEST_CASE("Rough gas: free cooling of spheres tends to one ratio of the temperatures") {
  check_cooling<3>({{0.9, 0.0}, {0.9, 0.5}, {0.95, -0.5}, {0.8, 0.9}}, 80);
}

TEST_CASE("Rough gas: kicks of the motion alone set both temperatures") {
  std::uint64_t seed = 341;
  for (const Pair& pair : {Pair{0.9, 0.0}, Pair{0.8, 0.5}, Pair{0.9, -0.5}}) {
    check_kicked(pair, 2, 4000.0, seed++);
  }
}

TEST_CASE("Rough gas: kicks of the motion of spheres alone set both temperatures") {
  std::uint64_t seed = 344;
  for (const Pair& pair : {Pair{0.9, 0.0}, Pair{0.8, 0.5}, Pair{0.9, -0.5}}) {
    check_kicked(pair, 3, 2000.0, seed++);
  }
}

TEST_CASE("Rough gas: elastic, perfectly rough particles share the energy equally") {
  // alpha = beta = 1, phi = .2, N = 400, all energy in the motion at first. Energy and momentum are
  // constant, so each of the D (N-1) + D_r N degrees of freedom has the same mean energy.
  for (const int dimension : {2, 3}) {
    Scene scene = gas_of_fraction(0.2, 400, 1.0, dimension);
    scene.particles.roughness = {kUnlimited, 1.0};
    const Measured result = run(scene, 100.0, 1000.0, dimension == 2 ? 352 : 353);
    const int spins = dimension == 2 ? kSpinSize<2> : kSpinSize<3>;
    const double share = dimension * 400.0 / (dimension * 399.0 + spins * 400.0);
    const Estimate& spin = *result.spin_temperature;
    MESSAGE(dimension, "D: T_tr = ", result.temperature.mean, " +- ",
            result.temperature.standard_error, ", expected ", share * 399.0 / 400.0,
            "; T_rot = ", spin.mean, " +- ", spin.standard_error, ", expected ", share);
    CHECK(relative_error(spin) < 0.003);
    CHECK(std::fabs(relative(spin, share)) < 0.01);
    CHECK(std::fabs(spin.mean - share) < 5.0 * spin.standard_error);
    CHECK(std::fabs(result.temperature.mean - share * 399.0 / 400.0) <
          5.0 * result.temperature.standard_error);
  }
}

TEST_CASE("Driven gas: smooth particles have the temperature at which kicks balance the loss") {
  // beta = -1 in the theory of rough particles: A = (1 - alpha^2)/(2 (D - 1)), B = C = 0.
  for (const int dimension : {2, 3}) {
    Scene scene = gas_of_fraction(0.1, 100, 0.9, dimension);
    scene.bulk_drive = BulkDrive{.interval = 0.2, .kick_speed = std::sqrt(0.02)};
    const Measured result =
        run(scene, 100.0, dimension == 2 ? 4000.0 : 2000.0, dimension == 2 ? 351 : 354);
    const double power = 0.5 * dimension * 0.02 * (1.0 - 1.0 / 100.0) / 0.2;
    const double expected =
        RoughGas{0.9, -1.0, scene.particles.inertia, dimension}.driven_temperature(0.1, power);
    MESSAGE(dimension, "D: T = ", result.temperature.mean, " +- ",
            result.temperature.standard_error, ", theory ", expected);
    CHECK(!result.spin_temperature);
    CHECK(relative_error(result.temperature) < 0.01);
    CHECK(std::fabs(relative(result.temperature, expected)) < 0.05);
    CHECK(std::fabs(result.bulk_in->mean - 100.0 * power) < 5.0 * result.bulk_in->standard_error);
    check_energy_balance(result, 100);
  }
}
