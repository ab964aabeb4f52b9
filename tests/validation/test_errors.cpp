#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/scene/scene_file.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("Standard errors: they are the scatter of the means of runs with other seeds") {
  // The gallery scene "vibrated" has a temperature with a correlation time of about 16, a pressure
  // whose fluctuations cancel in time, and collisions that are nearly independent. 48 runs of 1000
  // time units: the scatter has an uncertainty of 1/sqrt(2 47) = 10 %, the mean squared error of
  // these runs has 22 %/sqrt(48) = 3 %. The ratio is within 5 of these of 1, of which less than 0.2
  // is the systematic error of the estimate (theory 10.2).
  constexpr int kRuns = 48;
  struct Sum {
    double mean = 0.0, square = 0.0, squared_error = 0.0;
    void add(const Estimate& estimate) {
      mean += estimate.mean / kRuns;
      square += estimate.mean * estimate.mean / kRuns;
      squared_error += estimate.standard_error * estimate.standard_error / kRuns;
    }
  };
  std::map<std::string, Sum> sums;
  const Scene scene = load_scene("vibrated");
  for (int k = 0; k < kRuns; ++k) {
    const Measured result = run(scene, 500.0, 1000.0, 2000 + static_cast<std::uint64_t>(k));
    sums["temperature"].add(result.temperature);
    sums["temperature_x"].add(result.axis_temperatures[0]);
    sums["collision_rate"].add(result.collision_rate);
    sums["pressure.left"].add(*result.pressure[kLeft]);
    sums["walls_in"].add(*result.walls_in);
    sums["dissipated"].add(result.dissipated);
  }
  for (const auto& [name, sum] : sums) {
    CAPTURE(name);
    const double variance = (sum.square - sum.mean * sum.mean) * kRuns / (kRuns - 1.0);
    const double ratio = std::sqrt(variance / sum.squared_error);
    MESSAGE(name, ": scatter over standard error ", ratio);
    CHECK(ratio > 0.5);
    CHECK(ratio < 1.5);
  }
}
