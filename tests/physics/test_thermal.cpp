#include <doctest/doctest.h>

#include <cmath>

#include "tests/physics/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene between(double left, double right) {
  Scene scene = gas(20.0, 15.0, 80, 1.0);
  scene.walls[kLeft] = {.kind = WallKind::Thermal, .temperature = left};
  scene.walls[kRight] = {.kind = WallKind::Thermal, .temperature = right};
  scene.disks.start.temperature = 0.5 * (left + right);
  scene.measure.fields = {Field::Density, Field::TemperatureX, Field::TemperatureY};
  scene.measure.cells = {5, 1};
  return scene;
}

}  // namespace

TEST_CASE("thermal walls: a gas between two of one temperature takes it") {
  constexpr double kTemperature = 2.0;
  Scene scene = between(kTemperature, kTemperature);
  scene.disks.start.temperature = 0.5;  // to be forgotten in the burn-in
  const Measured result = run(scene, 300.0, 30000.0, 121);
  MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error, ", walls ",
          kTemperature);
  CHECK(relative_error(result.temperature) < 0.003);
  CHECK(std::fabs(relative(result.temperature, kTemperature)) < 0.01);
  // Canonical: each component is Gaussian, everywhere alike, without the 1/N of a fixed energy.
  for (const Estimate& kurtosis : {result.kurtosis_excess_x, result.kurtosis_excess_y}) {
    CHECK(kurtosis.standard_error < 0.02);
    CHECK(std::fabs(kurtosis.mean) < 3.0 * kurtosis.standard_error);
  }
  for (const auto* component :
       {&result.profile->at(Field::TemperatureX), &result.profile->at(Field::TemperatureY)}) {
    for (const Estimate& local : *component) {
      CHECK(std::fabs(local.mean - kTemperature) < 5.0 * local.standard_error);
    }
  }
  // In equilibrium the walls give nothing on average.
  CHECK(std::fabs(result.walls_in->mean) < 3.0 * result.walls_in->standard_error);
}

TEST_CASE("thermal walls: heat flows from the hot one to the cold one, and matter does not") {
  const Measured result = run(between(3.0, 1.0), 200.0, 10000.0, 122);
  const auto& profile = *result.profile;
  for (std::size_t i = 0; i + 1 < profile.at(Field::Density).size(); ++i) {
    CAPTURE(i);
    CHECK(profile.at(Field::TemperatureX)[i].mean > profile.at(Field::TemperatureX)[i + 1].mean);
    CHECK(profile.at(Field::TemperatureY)[i].mean > profile.at(Field::TemperatureY)[i + 1].mean);
    CHECK(profile.at(Field::Density)[i].mean < profile.at(Field::Density)[i + 1].mean);
  }
  // Both walls bear the same pressure, and what one gives the other takes: nothing is left over.
  const Estimate& left = *result.pressure[kLeft];
  const Estimate& right = *result.pressure[kRight];
  const double error = std::hypot(left.standard_error, right.standard_error);
  MESSAGE("pressures ", left.mean, " and ", right.mean, " +- ", error);
  CHECK(error < 0.01 * left.mean);
  CHECK(std::fabs(left.mean - right.mean) < 3.0 * error);
  MESSAGE("walls in = ", result.walls_in->mean, " +- ", result.walls_in->standard_error);
  CHECK(std::fabs(result.walls_in->mean) < 3.0 * result.walls_in->standard_error);
}
