#include <doctest/doctest.h>

#include <cmath>

#include "engine/physics/theory.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Stationary temperature of the standard gas (theory 7.11).
double refined(double restitution, double wall_restitution) {
  return VibratedGas{100.0, 20.0, 25.0, restitution, wall_restitution, 1.0}.temperature_refined();
}

void report(const Measured& result, double expected) {
  MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error,
          ", theory 7.11 ", expected);
}

}  // namespace

TEST_CASE("Vibrated gas: theory 7.11 holds for elastic particles between lossy walls, within 1 %") {
  // All loss is at the walls. The density at the walls, uniform in theory, therefore cancels from
  // the balance (theory 7.1).
  const double expected = refined(1.0, 0.9);
  Scene scene = vibrated_gas(1.0, 0.9);
  scene.particles.start.temperature = expected;
  const Measured result = run(scene, 500.0, 10000.0, 111);
  report(result, expected);
  CHECK(relative_error(result.temperature) < 0.004);
  CHECK(std::fabs(relative(result.temperature, expected)) < 0.01);
  check_energy_balance(result, 100);
  CHECK(result.dissipated.mean < 1e-9);
}

TEST_CASE(
    "Vibrated gas: theory 7.11 holds for inelastic particles between elastic walls, within 4 %") {
  const double expected = refined(0.9, 1.0);
  const Measured result = run(vibrated_gas(0.9, 1.0), 300.0, 25000.0, 112);
  report(result, expected);
  CHECK(relative_error(result.temperature) < 0.004);
  CHECK(std::fabs(relative(result.temperature, expected)) < 0.04);
  check_energy_balance(result, 100);
  CHECK(result.dissipated.mean > 0.1);
}

TEST_CASE(
    "Vibrated gas: theory 7.11 holds for inelastic particles between lossy walls, within 5 %") {
  const double expected = refined(0.9, 0.9);
  const Measured result = run(vibrated_gas(0.9, 0.9), 300.0, 10000.0, 115);
  report(result, expected);
  CHECK(relative_error(result.temperature) < 0.006);
  CHECK(std::fabs(relative(result.temperature, expected)) < 0.05);
  check_energy_balance(result, 100);
}

TEST_CASE("Vibrated gas: it is hottest along x at the walls, and densest in the middle") {
  // The walls heat the x direction only: T_x > T_y, and the centre is coldest.
  Scene scene = vibrated_gas(0.9, 1.0);
  scene.measure.fields = {Quantity::Density, Field(Quantity::Temperature, 0)};
  scene.measure.cells = {10, 1};
  const Measured result = run(scene, 300.0, 5000.0, 114);
  const double error = std::hypot(result.axis_temperatures[0].standard_error,
                                  result.axis_temperatures[1].standard_error);
  CHECK(result.axis_temperatures[0].mean - result.axis_temperatures[1].mean > 10.0 * error);
  const auto& profile = *result.profile;
  CHECK(profile.at(Field(Quantity::Temperature, 0)).front().mean >
        1.2 * profile.at(Field(Quantity::Temperature, 0))[5].mean);
  CHECK(profile.at(Field(Quantity::Temperature, 0)).back().mean >
        1.2 * profile.at(Field(Quantity::Temperature, 0))[5].mean);
  CHECK(profile.at(Quantity::Density)[5].mean > 1.2 * profile.at(Quantity::Density).front().mean);
  // Mirror symmetry, within 5 standard errors.
  for (int i = 0; i < 5; ++i) {
    const Estimate& left = profile.at(Quantity::Density)[i];
    const Estimate& right = profile.at(Quantity::Density)[9 - i];
    CHECK(std::fabs(left.mean - right.mean) <
          5.0 * std::hypot(left.standard_error, right.standard_error));
  }
}
