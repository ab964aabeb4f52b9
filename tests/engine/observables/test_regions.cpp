// Probe, and velocities of the particles in a region.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kRegionInterval = 0.7;
constexpr int kRegionSamples = 60;

// Velocities of the particles between two corners.
template <int D>
std::vector<Vec<D>> velocities_in(const State<D>& state, const VecX& lower, const VecX& upper) {
  std::vector<Vec<D>> inside;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    bool in = true;
    for (int axis = 0; axis < D; ++axis) {
      const double place = state.positions[i][axis];
      in = in && place >= lower[axis] && place < upper[axis];
    }
    if (in) inside.push_back(state.velocities[i]);
  }
  return inside;
}

template <int D>
Vec<D> mean_velocity(const std::vector<Vec<D>>& velocities) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Vec<D>& velocity : velocities) sum += velocity;
  return sum / static_cast<double>(velocities.size());
}

}  // namespace

// A region at a wall, and the default, the middle.
TEST_CASE_TEMPLATE("Probe: the series has density, temperature and velocity of each sample",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = heated_gas<D>();
  for (const bool at_wall : {true, false}) {
    CAPTURE(at_wall);
    VecX lower = 0.25 * scene.box, upper = 0.75 * scene.box;
    Measure measure;
    measure.probe.interval = kRegionInterval;
    if (at_wall) {
      lower = VecX::Zero(D);
      lower[1] = 1.5;
      upper = scene.box;
      upper[0] = 3.1;
      measure.probe.region = {lower, upper};
    }
    const Measured measured =
        observed<D>(scene, measure, ObservableKind::Probe, kRegionSamples * kRegionInterval, 3);
    const ResultTable table = table_of(measured, "probe.series");
    const auto simulation = simulation_of<D>(scene, 3);
    const double volume = (upper - lower).prod();
    double number = 0.0, square = 0.0, freedoms = 0.0, energy = 0.0, along = 0.0;
    REQUIRE(table.columns[0].values.size() == kRegionSamples);
    for (std::size_t k = 0; k < kRegionSamples; ++k) {
      CAPTURE(k);
      const double time = static_cast<double>(k + 1) * kRegionInterval;
      simulation->run_until(time);
      const auto inside = velocities_in<D>(simulation->state(), lower, upper);
      const auto count = static_cast<double>(inside.size());
      CHECK(column_of(table, "time").values[k] == doctest::Approx(time).epsilon(1e-12));
      CHECK(column_of(table, "density").values[k] == doctest::Approx(count / volume));
      number += count;
      square += count * count;
      const double x = inside.empty() ? NAN : mean_velocity<D>(inside)[0];
      CHECK(std::isnan(column_of(table, "velocity_x").values[k]) == inside.empty());
      CHECK(std::isnan(column_of(table, "temperature").values[k]) == (inside.size() < 2));
      if (inside.empty()) continue;
      along += count * x;
      CHECK(column_of(table, "velocity_x").values[k] == doctest::Approx(x).epsilon(1e-9));
      CHECK(column_of(table, D == 2 ? "velocity_y" : "velocity_z").values[k] ==
            doctest::Approx(mean_velocity<D>(inside)[D - 1]).epsilon(1e-9));
      if (inside.size() < 2) continue;
      double squares = 0.0;
      for (const Vec<D>& v : inside) squares += (v - mean_velocity<D>(inside)).squaredNorm();
      CHECK(column_of(table, "temperature").values[k] ==
            doctest::Approx(squares / (D * (count - 1.0))).epsilon(1e-9));
      energy += squares;
      freedoms += D * (count - 1.0);
    }
    const double mean = number / kRegionSamples;
    CHECK(mean_of(measured, "probe.density").mean == doctest::Approx(mean / volume));
    CHECK(mean_of(measured, "probe.number_variance").mean ==
          doctest::Approx(square / kRegionSamples - mean * mean).epsilon(1e-9));
    CHECK(mean_of(measured, "probe.temperature").mean ==
          doctest::Approx(energy / freedoms).epsilon(1e-9));
    CHECK(mean_of(measured, "probe.velocity_x").mean ==
          doctest::Approx(along / number).epsilon(1e-9));
  }
}

// 10,000 samples: rows of four samples each.
TEST_CASE("Probe: a long series has at most 4096 rows, averages of equal times") {
  Measure measure;
  measure.probe.interval = 0.01;
  const Measured measured =
      observed<2>(heated_gas<2>(), measure, ObservableKind::Probe, 100.004, 3);
  const ResultTable table = table_of(measured, "probe.series");
  const std::vector<double> times = column_of(table, "time").values;
  REQUIRE(times.size() == 2500);
  double density = 0.0;
  for (std::size_t row = 0; row < times.size(); ++row) {
    CHECK(times[row] == doctest::Approx(0.025 + 0.04 * static_cast<double>(row)));
    density += column_of(table, "density").values[row] / 2500.0;
  }
  CHECK(density == doctest::Approx(mean_of(measured, "probe.density").mean).epsilon(1e-9));
}

// The total momentum is 0 and sum v^2 = D N, so the velocities of two particles have a correlation
// of -1/(N - 1). The temperature about the mean of any of them is then N/(N - 1). Sample: 4000
// states, a mean free time apart.
TEST_CASE_TEMPLATE("Probe: a gas in equilibrium has its temperature and density in each region",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = gas(VecX::Constant(D, D == 2 ? 12.0 : 6.0), 40, 1.0);
  Measure measure;
  measure.probe = {.interval = 2.0, .region = {0.1 * scene.box, 0.5 * scene.box}};
  const Measured measured = observed<D>(scene, measure, ObservableKind::Probe, 8000.0, 4);
  const Estimate temperature = mean_of(measured, "probe.temperature");
  CHECK(temperature.standard_error < 0.01);
  CHECK(errors_off(temperature, 40.0 / 39.0) < 5.0);
  const double expected = 40.0 / scene.box.prod();
  const Estimate density = mean_of(measured, "probe.density");
  CHECK(density.standard_error < 0.02 * expected);
  CHECK(errors_off(density, expected) < 5.0);
  CHECK(errors_off(mean_of(measured, "probe.velocity_x"), 0.0) < 5.0);
}

// The distributions of one state, counted again.
TEST_CASE_TEMPLATE("Velocity distribution: a region has the velocities of its particles", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  constexpr double kTime = 5.0;
  const Scene scene = heated_gas<D>();
  VecX lower = VecX::Zero(D), upper = scene.box;
  lower[0] = 0.3 * scene.box[0];
  upper[1] = 0.8 * scene.box[1];
  Measure measure;
  measure.velocity_distribution = {
      .interval = kTime, .range = 2.0, .bins = 8, .region = {lower, upper}};
  const Measured measured =
      observed<D>(scene, measure, ObservableKind::VelocityDistribution, kTime, 3);
  const auto simulation = simulation_of<D>(scene, 3);
  simulation->run_until(kTime);
  const std::vector<Vec<D>> inside = velocities_in<D>(simulation->state(), lower, upper);
  const auto count = static_cast<double>(inside.size());
  REQUIRE(count > 8.0);
  REQUIRE(count < 26.0);
  const Vec<D> mean = mean_velocity<D>(inside);
  double squares = 0.0;
  for (const Vec<D>& v : inside) squares += (v - mean).squaredNorm();
  const double thermal = std::sqrt(squares / (D * (count - 1.0)));
  const double n = D * (count - 1.0), share = count / (count - 1.0);
  for (int axis = 0; axis < D; ++axis) {
    const std::string name(1, "xyz"[axis]);
    CAPTURE(name);
    std::vector<double> scaled;
    for (const Vec<D>& v : inside) scaled.push_back((v[axis] - mean[axis]) / thermal);
    const ResultTable table = table_of(measured, "velocity_distribution");
    check_density(table, name, scaled);
    for (std::size_t row = 0; row < 8; ++row) {
      const double low = -2.0 + 0.5 * static_cast<double>(row);
      CHECK(column_of(table, "low").values[row] == doctest::Approx(low));
      CHECK(column_of(table, "high").values[row] == doctest::Approx(low + 0.5));
    }
    CHECK(check_density(table_of(measured, "velocity_distribution.tails"), name, scaled) == count);
    double second = 0.0, third = 0.0, fourth = 0.0;
    for (const double number : scaled) {
      second += std::pow(number, 2) / count;
      third += std::pow(number, 3) / count;
      fourth += std::pow(number, 4) / count;
    }
    const auto moment = [&](const std::string& number) {
      return mean_of(measured, "velocity_distribution." + number + "_moment_" + name).mean;
    };
    CHECK(moment("second") == doctest::Approx(second * share));
    CHECK(moment("third") == doctest::Approx(third * std::pow(share, 1.5)));
    CHECK(moment("fourth") == doctest::Approx(fourth * share * share * (n + 2.0) / n));
  }
}

// The velocities of a part of an elastic gas, relative to their own mean and in units of their own
// thermal speed, are uniform on a sphere. The region has 4 of 40 particles, and their number
// varies. Sample: 8000 states.
TEST_CASE_TEMPLATE("Velocity distribution: a small region of an elastic gas is Gaussian", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = gas(VecX::Constant(D, D == 2 ? 14.0 : 7.0), 40, 1.0);
  VecX upper = scene.box;
  upper[0] *= 0.1;
  Measure measure;
  measure.velocity_distribution = {.interval = 2.0, .region = {{}, upper}};
  const Measured measured =
      observed<D>(scene, measure, ObservableKind::VelocityDistribution, 16'000.0, 6);
  const auto check = [&](const std::string& name, double expected, double precision) {
    CAPTURE(name);
    const Estimate mean = mean_of(measured, "velocity_distribution." + name);
    CHECK(mean.standard_error < precision);
    CHECK(errors_off(mean, expected) < 5.0);
  };
  check("a2", 0.0, 0.01);
  check("a3", 0.0, 0.05);
  for (const std::string axis : D == 2 ? std::vector{"x", "y"} : std::vector{"x", "y", "z"}) {
    check("second_moment_" + axis, 1.0, 0.02);
    check("third_moment_" + axis, 0.0, 0.03);
    check("fourth_moment_" + axis, 3.0, 0.06);
  }
}
