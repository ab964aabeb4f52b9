#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/physics/collision.h"
#include "engine/physics/mixture_theory.h"
#include "engine/physics/theory.h"
#include "tests/support/dimensions.h"
#include "tests/support/statistics.h"

namespace clatter::mixture_theory {

using namespace testing;

namespace {

/// Two species, the first of diameter 1 and mass 1, at a packing fraction.
MixtureGas binary(int dimension, double fraction, std::array<double, 2> counts, double diameter,
                  double mass, double restitution, double beta = -1.0) {
  const double q = dimension == 2 ? 0.5 : 0.4;
  MixtureGas gas;
  gas.dimension = dimension;
  gas.species = 2;
  gas.components = {
      {.species = 0, .count = counts[0], .inertia = q},
      {.species = 1, .count = counts[1], .diameter = diameter, .mass = mass, .inertia = q}};
  gas.contacts.assign(4, {restitution, beta});
  gas.volume = 1.0;
  gas.volume = gas.packing_fraction() / fraction;
  return gas;
}

double ratio(const MixtureTemperatures& temperatures) {
  return temperatures.translational[1] / temperatures.translational[0];
}

}  // namespace

// Figures of a separate program, which an independent simulator confirmed: pairs per time within 1
// %, Z within 0.5 %.
TEST_CASE("Mixture theory: elastic gases have the known Z, collision rates and temperatures") {
  const auto check = [](const MixtureGas& gas, double z, std::array<double, 3> pairs,
                        std::array<double, 2> temperatures) {
    const MixtureTemperatures equal = gas.equal(1.0);
    CHECK(gas.compressibility() == doctest::Approx(z).epsilon(2e-4));
    CHECK(gas.compressibility(equal) == doctest::Approx(gas.compressibility()).epsilon(1e-14));
    CHECK(gas.pair_rate(0, 0, equal) == doctest::Approx(pairs[0]).epsilon(1e-3));
    CHECK(gas.pair_rate(0, 1, equal) == doctest::Approx(pairs[1]).epsilon(1e-3));
    CHECK(gas.pair_rate(1, 0, equal) == doctest::Approx(pairs[1]).epsilon(1e-3));
    CHECK(gas.pair_rate(1, 1, equal) == doctest::Approx(pairs[2]).epsilon(2e-3));
    const std::vector<double> found = gas.elastic_temperatures(1.0);
    CHECK(found[0] == doctest::Approx(temperatures[0]).epsilon(1e-4));
    CHECK(found[1] == doctest::Approx(temperatures[1]).epsilon(1e-4));
    CHECK(gas.mean(found) == doctest::Approx(1.0).epsilon(1e-14));
  };
  check(binary(2, 0.4, {100, 50}, 2.0, 4.0, 1.0), 2.7037, {62.1, 79.3, 18.4}, {1.0034, 0.9933});
  check(binary(3, 0.3, {160, 40}, 2.0, 8.0, 1.0), 3.402, {226.0, 214.7, 26.9}, {1.0029, 0.9883});
}

// Figures of the same program, for collisions in a gas of many particles. The ratios of disks of
// one size do not depend on the density.
TEST_CASE("Mixture theory: temperature ratios of free cooling and of the three laws of kicks") {
  const auto cooling = binary(2, 0.2, {1e6, 1e6}, 1.0, 10.0, 0.9).cooling();
  REQUIRE(cooling);
  CHECK(ratio(cooling->ratios) == doctest::Approx(1.464).epsilon(5e-4));
  CHECK(cooling->ratios.translational[0] + cooling->ratios.translational[1] ==
        doctest::Approx(2.0).epsilon(1e-14));
  const MixtureGas gas = binary(2, 0.3, {1e6, 1e6}, 1.0, 5.0, 0.8);
  const MixtureGas kicked = binary(2, 0.3, {100, 100}, 1.0, 5.0, 0.8);
  const double root = std::sqrt(5.0);
  const auto driven_ratio = [&](double heavy_kick) {
    MixtureTemperatures heating = gas.equal(0.0);
    heating.translational = kicked.kick_powers({1.0, heavy_kick}, 0.1);
    const auto driven = gas.driven(heating);
    REQUIRE(driven);
    // At rest: collisions lose what the kicks give.
    const MixtureTemperatures changes = gas.changes(*driven);
    for (std::size_t s = 0; s < 2; ++s) {
      CHECK(changes.translational[s] == doctest::Approx(-heating.translational[s]).epsilon(1e-9));
    }
    return ratio(*driven);
  };
  CHECK(driven_ratio(1.0) == doctest::Approx(1.826).epsilon(5e-4));
  CHECK(driven_ratio(1.0 / root) == doctest::Approx(1.323).epsilon(5e-4));
  CHECK(driven_ratio(0.2) == doctest::Approx(0.923).epsilon(5e-4));
}

TEST_CASE("Mixture theory: species that are equal have the theory of one species") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const double partners = 99.0 / 100.0;  // a particle does not meet itself
    const double phi = 0.27, alpha = 0.8, q = dimension == 2 ? 0.5 : 0.4, beta = 0.4;
    const MixtureGas smooth = binary(dimension, phi, {70, 30}, 1.0, 1.0, alpha);
    const MixtureTemperatures equal = smooth.equal(1.7);
    CHECK(smooth.contact_correlation(1.0, 1.0) ==
          doctest::Approx(contact_correlation(phi, dimension)).epsilon(1e-14));
    CHECK(smooth.compressibility(equal) ==
          doctest::Approx(compressibility(phi, alpha, dimension)).epsilon(1e-14));
    CHECK(smooth.collision_rate(0, 0, equal) + smooth.collision_rate(0, 1, equal) ==
          doctest::Approx(partners * enskog_rate(phi, 1.7, dimension)).epsilon(1e-14));
    const auto cooling = smooth.cooling();
    REQUIRE(cooling);
    CHECK(ratio(cooling->ratios) == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(
        -0.5 * cooling->rate * std::sqrt(1.3) ==
        doctest::Approx(partners * haff_rate_periodic(phi, alpha, 1.3, dimension)).epsilon(1e-12));
    CHECK(smooth.kick_powers({0.3, 0.3}, 0.7)[1] ==
          doctest::Approx(bulk_drive_power(100.0, 0.3, 0.7, dimension)).epsilon(1e-12));

    const MixtureGas rough = binary(dimension, phi, {70, 30}, 1.0, 1.0, alpha, beta);
    const RoughGas one{alpha, beta, q, dimension};
    const auto spinning = rough.cooling();
    REQUIRE(spinning);
    CHECK(spinning->ratios.rotational[1] == doctest::Approx(one.cooling_ratio()).epsilon(1e-9));
    const double power = 0.15;
    MixtureTemperatures heating = rough.equal(2.0 * power / dimension);
    const auto driven = rough.driven(heating);
    REQUIRE(driven);
    CHECK(driven->translational[0] ==
          doctest::Approx(one.driven_temperature(phi, power / partners)).epsilon(1e-9));
    CHECK(driven->rotational[0] / driven->translational[0] ==
          doctest::Approx(one.driven_ratio()).epsilon(1e-9));
  }
}

// The first particle is alone in its species: it meets the second one only, and elastically.
TEST_CASE("Mixture theory: a lone particle does not collide with itself") {
  MixtureGas gas = binary(2, 0.2, {1, 1}, 1.0, 2.0, 0.5, 0.3);
  gas.contacts[1] = gas.contacts[2] = {};
  CHECK(gas.pair_rate(0, 0, gas.equal(1.0)) == 0.0);
  CHECK(gas.collision_rate(0, 0, gas.equal(1.0)) == 0.0);
  CHECK(gas.collision_rate(0, 1, gas.equal(1.0)) > 0.0);
  CHECK(std::fabs(gas.changes(gas.equal(1.0)).translational[0]) < 1e-13);
  CHECK_FALSE(gas.spins(0));
  gas.components[1].count = 2.0;
  CHECK_FALSE(gas.spins(0));
  CHECK(gas.spins(1));
}

// Martin & Piasecki 1999: a tracer in a gas of a given temperature.
TEST_CASE("Mixture theory: a tracer has the temperature of Martin and Piasecki") {
  for (const double mass : {0.2, 1.0, 10.0, 1000.0}) {
    CAPTURE(mass);
    MixtureGas gas = binary(3, 0.1, {1e9, 1e-3}, 1.5, mass, 0.99);
    const double alpha = 0.7;
    gas.contacts[1] = gas.contacts[2] = {alpha, -1.0};
    // The heating of the gas keeps it at 1; the tracer has none.
    const double loss = -gas.changes(gas.equal(1.0)).translational[0];
    const auto driven = gas.driven({{loss, 0.0}, {0.0, 0.0}});
    REQUIRE(driven);
    CHECK(driven->translational[0] == doctest::Approx(1.0).epsilon(1e-9));
    CHECK(driven->translational[1] ==
          doctest::Approx((1.0 + alpha) / (2.0 + (1.0 - alpha) / mass)).epsilon(1e-7));
  }
}

TEST_CASE("Mixture theory: elastic species have equal temperatures under any drive of one") {
  MixtureGas gas = binary(2, 0.2, {100, 100}, 2.0, 7.0, 1.0);
  const MixtureTemperatures changes = gas.changes(gas.equal(2.3));
  CHECK(std::fabs(changes.translational[0]) < 1e-13);
  CHECK(std::fabs(changes.translational[1]) < 1e-13);
  MixtureTemperatures unequal = gas.equal(1.0);
  unequal.translational[1] = 2.0;
  const MixtureTemperatures exchange = gas.changes(unequal);
  CHECK(exchange.translational[0] > 0.0);
  CHECK(exchange.translational[0] == doctest::Approx(-exchange.translational[1]).epsilon(1e-13));
}

namespace {

/// Mean gains of particle 1 in simulated collisions with the laws of collision.h, and their
/// standard errors. Velocities and spins are Maxwellian; approaching pairs are met in proportion to
/// their speed.
template <int D>
std::array<Sample, 2> sampled_gains(const std::array<Grain, 2>& grains,
                                    const std::array<double, 2>& T, const std::array<double, 2>& R,
                                    const ContactLaw& law, int collisions, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> exponential;
  const Partners partners(grains[0], grains[1]);
  const double variance = T[0] / grains[0].mass + T[1] / grains[1].mass;
  std::array<Sample, 2> gains;
  for (int k = 0; k < collisions; ++k) {
    std::array<Vec<D>, 2> v;
    std::array<Spin<D>, 2> spins;
    for (std::size_t i = 0; i < 2; ++i) {
      for (double& component : v[i]) component = std::sqrt(T[i] / grains[i].mass) * normal(random);
      for (double& component : spins[i]) {
        component = std::sqrt(R[i] / grains[i].moment_of_inertia()) * normal(random);
      }
    }
    // The normal is x. The relative velocity along it has the density u exp(-u^2/2 Theta); the
    // other independent combination stays.
    const double approach = -std::sqrt(2.0 * variance * exponential(random));
    const double excess = approach - (v[0][0] - v[1][0]);
    v[0][0] += excess * T[0] / grains[0].mass / variance;
    v[1][0] -= excess * T[1] / grains[1].mass / variance;
    const Vec<D> x = partners.distance * Vec<D>::Unit(0);
    const Spin<D> surface = grains[0].radius * spins[0] + grains[1].radius * spins[1];
    const Exchange<D> exchange = rough_impulse<D>(x, v[0] - v[1], surface, law, partners);
    const Impulse<D> gain = exchange.of(0);
    gains[0].add(gain.momentum.dot(v[0] + 0.5 * gain.momentum / grains[0].mass));
    gains[1].add(grains[0].moment_of_inertia() * gain.spin.dot(spins[0] + 0.5 * gain.spin));
  }
  return gains;
}

}  // namespace

// 200,000 collisions; the standard errors are below 1 % of T. Width: 4.5 standard errors of 16
// numbers.
TEST_CASE_TEMPLATE("Mixture theory: changes of temperatures are means over simulated collisions",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const std::array<Grain, 2> grains = {
      Grain{.radius = 0.5, .mass = 1.0, .inertia = 0.4, .species = 0},
      Grain{.radius = 0.9, .mass = 3.0, .inertia = 0.3, .species = 1}};
  unsigned seed = 1;
  for (const double beta : {-1.0, 0.3}) {
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t second = 1 - first;
      const std::array<double, 2> T = {1.3, 2.1}, R = {0.7, 1.9};
      MixtureGas gas;
      gas.dimension = D;
      gas.volume = 1e4;
      gas.species = 2;
      gas.contacts.assign(4, {0.8, beta});
      for (std::size_t s = 0; s < 2; ++s) {
        // The first species is so rare that it meets the second one only.
        gas.components.push_back({.species = s,
                                  .count = s == first ? 1e-9 : 100.0,
                                  .diameter = 2.0 * grains[s].radius,
                                  .mass = grains[s].mass,
                                  .inertia = grains[s].inertia});
      }
      const MixtureTemperatures temperatures{{T[0], T[1]}, {R[0], R[1]}};
      const double rate = gas.collision_rate(first, second, temperatures);
      const MixtureTemperatures changes = gas.changes(temperatures);
      const ContactLaw law{0.8, beta > -1.0 ? std::numeric_limits<double>::infinity() : 0.0, beta};
      const std::array<Sample, 2> gains =
          sampled_gains<D>({grains[first], grains[second]}, {T[first], T[second]},
                           {R[first], R[second]}, law, 200000, seed++);
      const std::array<double, 2> expected = {changes.translational[first] * D / 2.0 / rate,
                                              changes.rotational[first] * (2 * D - 3) / 2.0 / rate};
      for (std::size_t k = 0; k < 2; ++k) {
        CAPTURE(k);
        CAPTURE(beta);
        CAPTURE(first);
        if (k == 1 && beta == -1.0) {
          CHECK(expected[k] == 0.0);
          continue;
        }
        CHECK(gains[k].standard_error() < 0.01 * T[first]);
        CHECK(std::fabs(gains[k].mean() - expected[k]) < 4.5 * gains[k].standard_error());
      }
    }
  }
}

// One species of unequal diameters, all of one material: uniform in 0.5..1.5 at phi = 0.4. A
// separate program has Z = 2.7436, which simulations confirmed within 0.1 %.
TEST_CASE("Mixture theory: Z of polydisperse disks") {
  constexpr int kClasses = 1000;
  MixtureGas gas;
  gas.contacts = {{}};
  for (int k = 0; k < kClasses; ++k) {
    const double d = 0.5 + (k + 0.5) / kClasses;
    gas.components.push_back({.count = 1.0, .diameter = d, .mass = d * d});
  }
  gas.volume = 1.0;
  gas.volume = gas.packing_fraction() / 0.4;
  CHECK(gas.compressibility() == doctest::Approx(2.7436).epsilon(3e-4));
}

// Enskog's coefficients of self-diffusion: of disks 1/(2 n d chi) sqrt(T/(pi m)), and of
// spheres 3/(8 n d^2 chi) sqrt(T/(pi m)) (Chapman & Cowling 1970, first approximation).
TEST_CASE("Mixture theory: Einstein's relation gives Enskog's coefficients of self-diffusion") {
  for (const int dimension : {2, 3}) {
    const MixtureGas gas = binary(dimension, 0.2, {5e5, 5e5}, 1.0, 1.0, 1.0);
    const double diffusion = 1.7 / gas.friction(0, gas.equal(1.7));
    const double n = 1e6 / gas.volume, chi = gas.contact_correlation(1.0, 1.0);
    const double expected = (dimension == 2 ? 0.5 : 0.375) / (n * chi) * std::sqrt(1.7 / M_PI);
    CHECK(diffusion == doctest::Approx(expected).epsilon(1e-5));
  }
}

// In a pair that is alone both velocities are shares of the relative one, whatever the masses. A
// collision takes the share 1 + alpha of its normal component: on average 2 (1 + alpha)/(D + 1) of
// the whole. Fast pairs collide more often, which makes it 2 (1 + alpha)/D of a mean velocity.
TEST_CASE("Mixture theory: two particles alone damp each other equally") {
  for (const double mass : {1.0, 100.0}) {
    const MixtureGas gas = binary(3, 0.01, {1, 1}, 2.0, mass, 0.8);
    const MixtureTemperatures equal = gas.equal(1.0);
    for (const std::size_t one : {0, 1}) {
      CHECK(gas.friction(one, equal) ==
            doctest::Approx(2.0 * 1.8 / 3.0 * gas.collision_rate(one, 1 - one, equal)));
    }
  }
}

}  // namespace clatter::mixture_theory
