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

constexpr int kColumns = 20, kRows = 24;

// Particles on a triangular lattice that fills a periodic box, with Gaussian velocities of mean 0.
struct Crystal {
  Model<2> model;
  State<2> start;
  explicit Crystal(double spacing) {
    const double height = spacing * 0.5 * std::sqrt(3.0);
    model = periodic_box(kColumns * spacing, kRows * height);
    start = random_gas(periodic_box(40.0, 48.0), kColumns * kRows, 921);
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        start.positions[static_cast<std::size_t>(row * kColumns + column)] = {
            (column + (row % 2 ? 0.75 : 0.25)) * spacing, (row + 0.5) * height};
      }
    }
  }
};

// Spacing of a triangular lattice with area fraction phi.
double spacing_of(double phi) {
  return std::sqrt(std::numbers::pi / (2.0 * std::sqrt(3.0) * phi));
}

void check_elastic(const Crystal& crystal) {
  Simulation<2> simulation(crystal.model, crystal.start);
  const double energy = simulation.kinetic_energy();
  simulation.run_until(kNever, 1000000);
  const double drift = std::fabs(simulation.kinetic_energy() / energy - 1.0);
  const double overlap = std::max(simulation.checks().deepest_overlap,
                                  brute_force_overlap(crystal.model, simulation.state()));
  MESSAGE("T off by ", brief(drift), ", least gap ", brief(-overlap), ", 1e6 collisions in ",
          brief(simulation.time()), " time units");
  CHECK(drift <= 1e-12);
  CHECK(overlap <= 1e-10);
  check_sound(simulation);
}

}  // namespace

TEST_CASE("Dense: phi = .70, where a fluid begins to freeze" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(Crystal(spacing_of(0.70)));
}

TEST_CASE("Dense: phi = .716, where a crystal begins to melt" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(Crystal(spacing_of(0.716)));
}

TEST_CASE("Dense: phi = .88, three per cent below the densest packing" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(Crystal(spacing_of(0.88)));
}

TEST_CASE("Dense: a hexagonal crystal at spacing 1 + 1e-11" *
          doctest::description("T constant to 1e-12, gap >= -1e-10")) {
  check_elastic(Crystal(1.0 + 1e-11));
}

// Kolafa & Rottner 2006: Z(.69) = 10.23. Relaxation is slow near freezing. Finite-size effects of
// 4000 particles are below .1 %.
TEST_CASE("Dense: equation of state at phi = .69, by the edge of freezing" *
          doctest::test_suite("slow") *
          doctest::description("Z within .5 % of 10.23 (Kolafa & Rottner 2006)")) {
  const Measured result = run(gas_of_fraction(0.69, 4000, 1.0), 100.0, 400.0, 922);
  REQUIRE(result.compressibility);
  const Estimate& z = *result.compressibility;
  const double off = relative(z, 10.23);
  MESSAGE("Z = ", z.mean, " +- ", brief(z.standard_error), ", off by ", brief(100.0 * off), " %");
  CHECK(relative_error(z) < 0.001);
  CHECK(std::fabs(off) < 0.005);
}
