#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "engine/observables/lag_history.h"
#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("Lag history: each lag compares with the sample of that age") {
  LagHistory<2> history({.interval = 0.5, .longest = 40.0, .lags = 4});
  const std::vector<std::uint64_t> expected = {0, 1, 2, 3, 4, 8, 12, 16, 32, 48, 64};
  REQUIRE(history.lags() == expected);
  std::vector<int> visits(expected.size(), 0);
  for (int number = 0; number < 500; ++number) {
    history.add({Vec2(number, 0.0)}, [&](std::size_t lag, const std::vector<Vec2>& earlier) {
      REQUIRE(earlier.size() == 1);
      REQUIRE(earlier[0][0] == number - static_cast<double>(expected[lag]));
      ++visits[lag];
    });
  }
  // The longest level keeps the samples that its lags need.
  CHECK(history.capacity() == 3 * 4);
  CHECK(history.is_complete(1));
  CHECK_FALSE(history.is_complete(2));
  // Lags of level k have an origin every 4^k samples.
  CHECK(visits == std::vector<int>{500, 499, 498, 497, 496, 123, 122, 121, 30, 29, 28});
}

TEST_CASE("Lag history: the longest lag may be a rounding error away") {
  CHECK(LagHistory<2>({.interval = 0.1, .longest = 0.3, .lags = 10}).lags().back() == 3);
  CHECK(LagHistory<2>({.interval = 1.0, .longest = 0.5, .lags = 10}).lags().size() == 1);
}

// Displacements over long lags overlap in time. The scatter of 32 runs gives their true errors,
// with a relative uncertainty of 12 %.
TEST_CASE("Mean-squared displacement: standard errors are the scatter between runs") {
  constexpr int kRuns = 32;
  Measure measure;
  measure.mean_squared_displacement = {.interval = 1.0, .longest = 100.0, .lags = 10};
  const Scene scene = gas(25.0, 25.0, 50, 1.0);
  std::vector<std::vector<double>> values, errors;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const TableColumn total = column_of(
        table_of(observed<2>(scene, measure, ObservableKind::MeanSquaredDisplacement, 1000.0, seed),
                 "mean_squared_displacement"),
        "total");
    values.push_back(total.values);
    errors.push_back(total.standard_errors);
  }
  for (const std::size_t lag : {1u, 5u, 10u, 13u}) {
    CAPTURE(lag);
    double mean = 0.0, squares = 0.0, reported = 0.0;
    for (std::size_t run = 0; run < kRuns; ++run) mean += values[run][lag] / kRuns;
    for (std::size_t run = 0; run < kRuns; ++run) {
      squares += std::pow(values[run][lag] - mean, 2) / (kRuns - 1);
      reported += std::pow(errors[run][lag], 2) / kRuns;
    }
    CHECK(std::sqrt(reported / squares) > 0.6);
    CHECK(std::sqrt(reported / squares) < 1.6);
  }
  // A lag of a tenth of the run has fewer than 8 independent parts.
  CHECK(std::isnan(errors[0].back()));
}

// A lone particle crosses the periodic box many times: its displacement is v t on each axis.
TEST_CASE_TEMPLATE("Mean-squared displacement: of one particle it is (v t)^2", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Scene scene = gas(VecX::LinSpaced(D, 3.0, 4.0), 1, 1.0);
  const Vec<D> v = Vec<D>::LinSpaced(0.3, -1.1);
  Simulation<D> simulation(model_of<D>(scene, 1), {{Vec<D>::Constant(1.0)}, {v}});
  Measure measure = scene.measure;
  measure.burn_in = 5.0;
  measure.observables = {ObservableKind::MeanSquaredDisplacement,
                         ObservableKind::VelocityAutocorrelation};
  measure.mean_squared_displacement = {.interval = 0.7, .longest = 60.0, .lags = 5};
  Measurement<D> measurement(simulation, measure, 300.0);
  simulation.run_until(300.0);
  const Measured measured = measurement.result();
  const ResultTable moved = table_of(measured, "mean_squared_displacement");
  const TableColumn time = column_of(moved, "time");
  REQUIRE(time.values.size() > 10);
  const std::array<const char*, 3> axes = {"x", "y", "z"};
  for (std::size_t lag = 0; lag < time.values.size(); ++lag) {
    const double t = time.values[lag];
    CHECK(column_of(moved, "total").values[lag] ==
          doctest::Approx(v.squaredNorm() * t * t).epsilon(1e-9));
    for (int axis = 0; axis < D; ++axis) {
      const std::string name = axes[static_cast<std::size_t>(axis)];
      CHECK(column_of(moved, name).values[lag] ==
            doctest::Approx(v[axis] * v[axis] * t * t).epsilon(1e-9));
      CHECK(column_of(moved, "drift_" + name).values[lag] ==
            doctest::Approx(v[axis] * t).epsilon(1e-9));
    }
  }
  const ResultTable correlation = table_of(measured, "velocity_autocorrelation");
  for (int axis = 0; axis < D; ++axis) {
    for (const double value : column_of(correlation, axes[static_cast<std::size_t>(axis)]).values) {
      CHECK(value == doctest::Approx(v[axis] * v[axis]).epsilon(1e-12));
    }
  }
  for (const double value : column_of(correlation, "mean").values) {
    CHECK(value == doctest::Approx(v.squaredNorm() / D).epsilon(1e-12));
  }
}

// Einstein relation: d MSD/dt = 2 D integral of C(t), with the mean C over the axes. Both are from
// the same samples, so the statistical errors cancel, and the error of the trapezoidal rule
// remains.
TEST_CASE_TEMPLATE("Mean-squared displacement: its slope is the integral of the autocorrelation",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const double side = D == 2 ? std::sqrt(500.0 * std::numbers::pi / 0.8)
                             : std::cbrt(500.0 * std::numbers::pi / 0.9);
  const Scene scene = gas(VecX::Constant(D, side), 500, 1.0);
  Measure measure = scene.measure;
  measure.burn_in = 5.0;
  measure.observables = {ObservableKind::MeanSquaredDisplacement,
                         ObservableKind::VelocityAutocorrelation};
  measure.mean_squared_displacement = {.interval = 0.05, .longest = 4.0, .lags = 80};
  measure.velocity_autocorrelation = measure.mean_squared_displacement;
  const auto simulation = simulation_of<D>(scene, 2);
  Measurement<D> measurement(*simulation, measure, 300.0);
  simulation->run_until(300.0);
  const Measured measured = measurement.result();
  const std::vector<double> moved =
      column_of(table_of(measured, "mean_squared_displacement"), "total").values;
  const std::vector<double> correlation =
      column_of(table_of(measured, "velocity_autocorrelation"), "mean").values;
  REQUIRE(moved.size() == 81);
  REQUIRE(correlation.size() == 81);
  double integral = 0.0;
  for (std::size_t k = 1; k + 1 < 80; ++k) {
    integral += 0.5 * 0.05 * (correlation[k - 1] + correlation[k]);
    const double slope = (moved[k + 1] - moved[k - 1]) / 0.1;
    CAPTURE(k);
    CHECK(slope == doctest::Approx(2.0 * D * integral).epsilon(0.02));
  }
}
