#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Z of an elastic periodic gas of 4000 particles. The deviation must be at most `width`, three
/// standard errors.
void check_compressibility(const Scene& scene, double literature, double width, double duration,
                           std::uint64_t seed) {
  const Measured result = run(scene, 0.1 * duration, duration, seed);
  REQUIRE(result.compressibility);
  const Estimate& z = *result.compressibility;
  MESSAGE("Z(", scene.packing_fraction(), ") = ", z.mean, " +- ", z.standard_error, ", literature ",
          literature, ", off by ", 100.0 * relative(z, literature), " %");
  CHECK(relative_error(z) < width / 3.0);
  CHECK(std::fabs(relative(z, literature)) < width);
}

/// Disks, within 0.3 %.
void check_disks(double area_fraction, double literature, double duration, std::uint64_t seed) {
  check_compressibility(gas_of_fraction(area_fraction, 4000, 1.0), literature, 0.003, duration,
                        seed);
}

/// Spheres, within 0.2 %.
void check_spheres(double volume_fraction, double duration, std::uint64_t seed) {
  check_compressibility(gas_of_fraction(volume_fraction, 4000, 1.0, 3),
                        sphere_compressibility(volume_fraction), 0.002, duration, seed);
}

/// 4000 spheres. chi follows from the published Z as (Z - 1)/(4 phi); Carnahan and Starling's chi
/// is accurate to 0.08 % at phi = .1 and to 0.4 % at phi = .4.
void check_sphere_rate(double phi, double duration, std::uint64_t seed) {
  const Measured result = run(gas_of_fraction(phi, 4000, 1.0, 3), 10.0, duration, seed);
  const double published = (sphere_compressibility(phi) - 1.0) / (4.0 * phi);
  const double theory = enskog_rate(phi, 1.0, 3);
  const double expected = theory * published / contact_correlation(phi, 3);
  MESSAGE("omega(", phi, ") = ", result.collision_rate.mean, " +- ",
          result.collision_rate.standard_error, ", Enskog ", theory, ", with the published chi ",
          expected);
  CHECK(relative_error(result.collision_rate) < 0.001);
  CHECK(std::fabs(relative(result.collision_rate, expected)) < 0.003);
  CHECK(std::fabs(relative(result.collision_rate, theory)) < 0.006);
}

/// Probability of a larger speed in Maxwell's distribution at T = 1.
double share_beyond(const Vec<2>& v) {
  return std::exp(-0.5 * v.squaredNorm());
}
double share_beyond(const Vec<3>& v) {
  const double x = v.norm() / std::numbers::sqrt2;
  return std::erfc(x) + 2.0 * std::numbers::inv_sqrtpi * x * std::exp(-x * x);
}

// 2000 particles, 100 samples, some ten collisions of each apart: 200,000 speeds in 40 bins of
// equal probability. The 1/N of the fixed energy shifts a bin by at most 0.05 %, a seventh of a
// standard error, which chi^2 cannot resolve.
template <int D>
void check_speeds(double interval, std::uint64_t seed) {
  constexpr int kBins = 40;
  constexpr int kSamples = 100;
  const Scene scene = gas_of_fraction(0.3, 2000, 1.0, D);
  Simulation<D> simulation(model_of<D>(scene, seed), start_state<D>(scene, seed));
  std::vector<double> counts(kBins);
  for (int k = 1; k <= kSamples; ++k) {
    simulation.run_until(interval * k);
    for (const Particle<D>& particle : simulation.particles()) {
      const double beyond = share_beyond(particle.flight.v);
      counts[static_cast<std::size_t>(std::min(beyond * kBins, kBins - 1.0))] += 1.0;
    }
  }
  const double mean = 2000.0 * kSamples / kBins;
  const double p = counts_p(counts, std::vector(kBins, mean));
  MESSAGE("chi^2 of the speeds: p = ", p);
  CHECK(p > kMinProbability);
  for (const double count : counts) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
}

// p = Z rho T between two elastic walls, with the density of the central part, six of ten columns,
// and Z as a function of the packing fraction.
// The standard error must be at most 0.6 %, the deviation at most 1.2 %.
void check_wall_pressure(Scene scene, double z(double), double duration, std::uint64_t seed) {
  wall_in(scene, 0, Wall{});
  scene.measure.fields = {Quantity::Density};
  scene.measure.cells.assign(scene.box.size(), 1);
  scene.measure.cells[0] = 10;
  const Measured result = run(scene, 50.0, duration, seed);
  double density = 0.0;
  for (int column = 2; column < 8; ++column)
    density += result.profile->at(Quantity::Density)[column].mean / 6.0;
  const double fraction = packing_fraction(scene.dimension(), density);
  const double expected = density * result.temperature.mean * z(fraction);
  for (const int side : {kLeft, kRight}) {
    const Estimate& pressure = *result.pressure[side];
    MESSAGE("pressure = ", pressure.mean, " +- ", pressure.standard_error, ", expected ", expected);
    CHECK(relative_error(pressure) < 0.006);
    CHECK(std::fabs(relative(pressure, expected)) < 0.012);
  }
}

}  // namespace

// Kolafa & Rottner 2006, Mol. Phys. 104, 3435: molecular dynamics and virial series of hard disks.
TEST_CASE("Elastic gas: Z agrees with the literature at phi = .31416") {
  check_disks(0.31416, 2.15144, 240.0, 101);
}

TEST_CASE("Elastic gas: Z agrees with the literature at phi = .47124") {
  check_disks(0.47124, 3.66369, 160.0, 102);
}

TEST_CASE("Elastic gas: the published compressibility of spheres agrees with the virial series") {
  // Z = 1 + sum B_n phi^(n-1), with B_2 to B_10 in units of the volume of a sphere: Clisby & McCoy
  // 2006, J. Stat. Phys. 122, 15. The next terms are about 130 phi^10 + 150 phi^11 + ... The fit
  // has B_2 to B_6, and B_7 within .04.
  constexpr double kVirial[] = {4.0,     10.0,   18.364768, 28.22445, 39.8151,
                                53.3413, 68.540, 85.813,    105.78};
  for (const double phi : {0.1, 0.2, 0.3}) {
    double series = 1.0, power = 1.0;
    for (const double coefficient : kVirial) series += coefficient * (power *= phi);
    CHECK(std::fabs(sphere_compressibility(phi) / series - 1.0) <
          150.0 * std::pow(phi, 10) + 0.05 * std::pow(phi, 6));
  }
}

TEST_CASE("Elastic gas: Z of spheres agrees with the literature at phi = .1") {
  check_spheres(0.1, 400.0, 108);
}

TEST_CASE("Elastic gas: Z of spheres agrees with the literature at phi = .2") {
  check_spheres(0.2, 240.0, 109);
}

TEST_CASE("Elastic gas: Z of spheres agrees with the literature at phi = .3") {
  check_spheres(0.3, 120.0, 110);
}

TEST_CASE("Elastic gas: Z of spheres agrees with the literature at phi = .4") {
  check_spheres(0.4, 100.0, 111);
}

TEST_CASE("Elastic gas: Z of spheres agrees with the literature at phi = .45") {
  check_spheres(0.45, 50.0, 112);
}

TEST_CASE("Elastic gas: the collision rate is Enskog's at phi = .1") {
  // Henderson's chi is accurate to 0.05 % here. At T = E/N (N = 4000) the rate is exact up to 1/N.
  const Measured result = run(gas_of_fraction(0.1, 4000, 1.0), 20.0, 1200.0, 103);
  const double expected = enskog_rate(0.1, 1.0);
  MESSAGE("omega = ", result.collision_rate.mean, " +- ", result.collision_rate.standard_error,
          ", Enskog ", expected);
  CHECK(relative_error(result.collision_rate) < 0.0012);
  CHECK(std::fabs(relative(result.collision_rate, expected)) < 0.005);
}

TEST_CASE("Elastic gas: the collision rate of spheres is Enskog's at phi = .1") {
  check_sphere_rate(0.1, 300.0, 113);
}

TEST_CASE("Elastic gas: the collision rate of spheres is Enskog's at phi = .4") {
  check_sphere_rate(0.4, 40.0, 114);
}

TEST_CASE("Elastic gas: the kurtosis of the velocities is Gaussian") {
  // Energy and momentum are fixed. Each component is therefore one coordinate on a sphere in n =
  // D(N-1) dimensions: <v^4>/(3 <v^2>^2) - 1 = -2/(n + 2), for D = 2 -1/N exactly.
  for (const int dimension : {2, 3}) {
    const Measured result = run(gas_of_fraction(0.3, 400, 1.0, dimension), 20.0,
                                dimension == 2 ? 1000.0 : 500.0, dimension == 2 ? 104 : 115);
    const double expected = -2.0 / (dimension * 399.0 + 2.0);
    REQUIRE(result.kurtosis_excess.size() == static_cast<std::size_t>(dimension));
    for (const Estimate& kurtosis : result.kurtosis_excess) {
      MESSAGE("kurtosis excess = ", kurtosis.mean, " +- ", kurtosis.standard_error, ", expected ",
              expected);
      CHECK(kurtosis.standard_error < 0.005);
      CHECK(std::fabs(kurtosis.mean - expected) < 3.0 * kurtosis.standard_error);
    }
  }
}

TEST_CASE("Elastic gas: speeds have Maxwell's distribution") {
  check_speeds<2>(5.0, 105);
}

TEST_CASE("Elastic gas: speeds of spheres have Maxwell's distribution") {
  check_speeds<3>(1.5, 116);
}

TEST_CASE("Elastic gas: all components have the same temperature") {
  for (const Scene& scene : {gas(30.0, 20.0, 200, 1.0), gas(Vec<3>(9.0, 7.0, 8.0), 200, 1.0)}) {
    const bool disks = scene.dimension() == 2;
    const Measured result = run(scene, 20.0, disks ? 1000.0 : 500.0, disks ? 106 : 117);
    for (std::size_t k = 0; k < result.axis_temperatures.size(); ++k) {
      // The energy is constant: T_x and T_y of disks have opposite deviations. Errors add up.
      const Estimate& a = result.axis_temperatures[k];
      const Estimate& b = result.axis_temperatures[(k + 1) % result.axis_temperatures.size()];
      const double error = a.standard_error + b.standard_error;
      MESSAGE("T_", k, " - T of the next axis = ", a.mean - b.mean, " +- ", error);
      CHECK(error < 0.01);
      CHECK(std::fabs(a.mean - b.mean) < 3.0 * error);
    }
    CHECK(result.temperature.mean == doctest::Approx(1.0).epsilon(1e-12));
  }
}

TEST_CASE("Elastic gas: the pressure on walls follows the equation of state") {
  // 60 long without 12 at each end. Z from Kolafa & Rottner's table would need a listed density.
  // Henderson's Z is accurate to 0.1 % at phi = .25.
  const auto henderson = [](double fraction) { return compressibility(fraction, 1.0); };
  check_wall_pressure(gas(60.0, 30.0, 573, 1.0), henderson, 6000.0, 107);
}

TEST_CASE("Elastic gas: the pressure of spheres on walls follows the equation of state") {
  // 30 long without 6 at each end.
  check_wall_pressure(gas(Vec<3>(30.0, 8.0, 9.0), 1031, 1.0), sphere_compressibility, 300.0, 118);
}
