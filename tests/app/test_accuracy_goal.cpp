#include <doctest/doctest.h>

#include "app/measure/accuracy_goal.h"
#include "app/results/result_json.h"

namespace clatter {

TEST_CASE("Accuracy goal: the error that counts rises as it did, and is relative to the mean") {
  CHECK(relative_error({.mean = -2.0, .standard_error = 0.1, .rise = 4.0, .drift = 7.0}) ==
        doctest::Approx(0.1));
  CHECK(std::isinf(relative_error({.mean = 0.0, .standard_error = 0.1})));
}

TEST_CASE("Accuracy goal: the names of means are the names in the result file") {
  Measured measured;
  const auto number = [](double mean) { return Estimate{.mean = mean}; };
  measured.temperature = number(1.0);
  measured.axis_temperatures = {number(2.0), number(3.0)};
  measured.spin_temperature = number(4.0);
  measured.kurtosis_excess = {number(5.0), number(6.0)};
  measured.collision_rate = number(7.0);
  measured.walls_in = number(8.0);
  measured.bulk_in = number(9.0);
  measured.gravity_in = number(10.0);
  measured.dissipated = number(11.0);
  measured.pressure = {number(12.0), number(13.0), number(14.0), number(15.0)};
  measured.compressibility = number(16.0);
  double expected = 0.0;
  for (const char* name :
       {"temperature", "temperature_x", "temperature_y", "spin_temperature", "kurtosis_excess_x",
        "kurtosis_excess_y", "collision_rate", "energy.walls_in", "energy.bulk_in",
        "energy.gravity_in", "energy.dissipated", "pressure.left", "pressure.right",
        "pressure.bottom", "pressure.top", "pressure.virial"}) {
    CAPTURE(name);
    AccuracyGoal goal;
    goal.of = name;
    CHECK(estimate_for(goal, measured).mean == ++expected);
  }
  CHECK(estimates_of(measured).size() == 16);
  CHECK(estimate_pointer("energy.walls_in").to_string() == "/energy/walls_in");
}

}  // namespace clatter
