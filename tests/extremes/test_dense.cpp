#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/dynamics/simulation.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// Particles on a lattice that fills a periodic box, with Gaussian velocities of mean 0.
template <int D>
struct Crystal {
  Model<D> model;
  State<D> start;
};

// A triangular lattice of 20 x 24 disks.
Crystal<2> triangular(double spacing) {
  constexpr int kColumns = 20, kRows = 24;
  const double height = spacing * 0.5 * std::sqrt(3.0);
  Crystal<2> crystal{periodic_box(kColumns * spacing, kRows * height),
                     random_gas(periodic_box(40.0, 48.0), kColumns * kRows, 921)};
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      crystal.start.positions[static_cast<std::size_t>(row * kColumns + column)] = {
          (column + (row % 2 ? 0.75 : 0.25)) * spacing, (row + 0.5) * height};
    }
  }
  return crystal;
}

// An fcc lattice of 5 x 5 x 5 cubes with four spheres each.
Crystal<3> face_centred(double spacing) {
  constexpr int kCubes = 5;
  const double edge = std::numbers::sqrt2 * spacing;
  Crystal<3> crystal{periodic_box<3>(Vec<3>::Constant(kCubes * edge)),
                     random_gas(periodic_box(20.0, 20.0, 20.0), 4 * kCubes * kCubes * kCubes, 921)};
  const Vec<3> corners[] = {
      {0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};
  for (std::size_t i = 0; i < crystal.start.positions.size(); ++i) {
    const auto cube = static_cast<int>(i / 4);
    const Vec<3> place(cube % kCubes, cube / kCubes % kCubes, cube / (kCubes * kCubes));
    crystal.start.positions[i] = edge * (place + corners[i % 4]);
  }
  return crystal;
}

// Spacing of a triangular lattice with area fraction phi.
double spacing_of(double phi) {
  return std::sqrt(std::numbers::pi / (2.0 * std::sqrt(3.0) * phi));
}

// Spacing of an fcc lattice with volume fraction phi.
double sphere_spacing_of(double phi) {
  return std::cbrt(std::numbers::pi / (std::sqrt(18.0) * phi));
}

template <int D>
void check_elastic(const Crystal<D>& crystal) {
  Simulation<D> simulation(crystal.model, crystal.start);
  const double energy = simulation.kinetic_energy();
  simulation.run_until(kNever, 1000000);
  const double drift = std::fabs(simulation.kinetic_energy() / energy - 1.0);
  const double overlap = std::max(simulation.checks().deepest_overlap,
                                  brute_force_overlap(crystal.model, simulation.state()));
  const double push = momentum(simulation.state()).norm() / simulation.particles().size();
  MESSAGE("T off by ", brief(drift), ", smallest gap ", brief(-overlap), ", 1e6 collisions in ",
          brief(simulation.time()), " time units");
  CHECK(drift <= 1e-12);
  CHECK(overlap <= 1e-10);
  CHECK(push <= 1e-12);
  check_sound(simulation);
}

}  // namespace

TEST_CASE("Dense: phi = .70, the freezing point of the fluid" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(triangular(spacing_of(0.70)));
}

TEST_CASE("Dense: phi = .716, the melting point of the crystal" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(triangular(spacing_of(0.716)));
}

TEST_CASE("Dense: phi = .88, three per cent below close packing" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(triangular(spacing_of(0.88)));
}

TEST_CASE("Dense: a hexagonal crystal at spacing 1 + 1e-11" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(triangular(1.0 + 1e-11));
}

TEST_CASE("Dense: spheres at phi = .545, the melting point of the crystal" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(face_centred(sphere_spacing_of(0.545)));
}

TEST_CASE("Dense: spheres at phi = .70, five per cent below close packing" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(face_centred(sphere_spacing_of(0.70)));
}

TEST_CASE("Dense: an fcc crystal at spacing 1 + 1e-11" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(face_centred(1.0 + 1e-11));
}

// Kolafa & Rottner 2006: Z(.69) = 10.23. Relaxation is slow near freezing. Finite-size effects of
// 4000 particles are below .1 %.
TEST_CASE("Dense: equation of state at phi = .69, just below freezing" *
          doctest::test_suite("slow") *
          doctest::description("Z within .5 % of 10.23 (Kolafa & Rottner 2006)")) {
  const Measured result = run(gas_of_fraction(0.69, 4000, 1.0), 100.0, 800.0, 922);
  REQUIRE(result.compressibility);
  const Estimate& z = *result.compressibility;
  const double off = relative(z, 10.23);
  MESSAGE("Z = ", z.mean, " +- ", brief(z.standard_error), ", off by ", brief(100.0 * off), " %");
  CHECK(relative_error(z) < 0.001);
  CHECK(std::fabs(off) < 0.005);
}
