#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/engine/observables/observed.h"
#include "tests/engine/support/gas.h"

// Observables of a sheared box: velocities without the flow, and distances through sliding images.

namespace clatter::shear_observables {

using namespace clatter::testing;

static Scene sheared_gas(int count, double restitution, double rate) {
  Scene scene = gas(14.0, 9.0, count, restitution);
  scene.shear_rate = rate;
  return scene;
}

// One disk at (3, 2) with c = (0.4, -0.6) at the start, in a box of height 9 with the rate 0.5. It
// crosses the border many times. c_x grows by 0.5 * 0.6 in a time unit, c_y and the height do not
// notice the flow.
TEST_CASE("Shear observables: correlations of one disk by hand") {
  Scene scene = sheared_gas(1, 1.0, 0.5);
  Simulation<2> simulation(model_of<2>(scene, 1),
                           {{{3.0, 2.0}}, {{0.4 + 0.5 * (2.0 - 4.5), -0.6}}});
  Measure measure = scene.measure;
  measure.burn_in = 0.0;
  measure.observables = {ObservableKind::MeanSquaredDisplacement,
                         ObservableKind::VelocityAutocorrelation};
  measure.mean_squared_displacement = {.interval = 1.0, .longest = 40.0, .lags = 4};
  measure.velocity_autocorrelation = {.interval = 1.0, .longest = 4.0, .lags = 4};
  Measurement<2> measurement(simulation, measure, 100.0);
  simulation.run_until(100.0);
  const Measured measured = measurement.result();
  const ResultTable moved = table_of(measured, "mean_squared_displacement");
  CHECK(moved.columns.size() == 4);  // time, total, y, drift_y
  for (std::size_t row = 0; row < moved.columns[0].values.size(); ++row) {
    const double lag = moved.columns[0].values[row];
    CHECK(column_of(moved, "total").values[row] == doctest::Approx(0.36 * lag * lag));
    CHECK(column_of(moved, "y").values[row] == doctest::Approx(0.36 * lag * lag));
    CHECK(column_of(moved, "drift_y").values[row] == doctest::Approx(-0.6 * lag));
  }
  // Samples at the times 1, 2, ..., 100.
  const ResultTable correlation = table_of(measured, "velocity_autocorrelation");
  for (std::size_t row = 0; row < correlation.columns[0].values.size(); ++row) {
    const auto lag = static_cast<int>(std::lround(correlation.columns[0].values[row]));
    double sum = 0.0;
    int origins = 0;
    for (int t = 1; t + lag <= 100; ++t, ++origins) {
      sum += (0.4 + 0.3 * t) * (0.4 + 0.3 * (t + lag));
    }
    CHECK(column_of(correlation, "x").values[row] == doctest::Approx(sum / origins));
    CHECK(column_of(correlation, "y").values[row] == doctest::Approx(0.36));
  }
}

// The speed along the normal is the momentum over (1 + alpha)/2 for the masses 1/2, and the loss
// (1 - alpha^2)/4 of its square.
class Impacts : public Observer<2> {
 public:
  std::vector<double> speeds, losses;

  void on_collision(const PairCollision<2>& collision) override {
    const double speed = collision.particles[0].gain.momentum.norm() / 0.9;
    speeds.push_back(speed);
    losses.push_back(0.09 * speed * speed);
  }
};

TEST_CASE("Shear observables: impacts and their losses follow from the momentum") {
  const Scene scene = sheared_gas(30, 0.8, 1.5);
  Measure measure = scene.measure;
  measure.burn_in = 0.0;
  measure.observables = {ObservableKind::Collisions};
  const auto simulation = simulation_of<2>(scene, 5);
  Measurement<2> measurement(*simulation, measure, 60.0);
  Impacts impacts;
  const Observation<2> observation(*simulation, impacts);
  simulation->run_until(60.0);
  const Measured measured = measurement.result();
  check_numbers(measured, "collisions.normal_speed", "collisions.mean_normal_speed", "",
                impacts.speeds);
  check_numbers(measured, "collisions.energy_loss", "collisions.mean_energy_loss", "",
                impacts.losses);
}

// Paths between collisions, from speeds at the middle of short steps.
class Paths : public Observer<2> {
 public:
  std::vector<double> whole;
  std::vector<double> since = std::vector<double>(30, std::nan(""));

  void on_collision(const PairCollision<2>& collision) override {
    for (const ParticleChange<2>& change : collision.particles) {
      double& path = since[change.particle];
      if (!std::isnan(path)) whole.push_back(path);
      path = 0.0;
    }
  }
};

// Samples of the states at many times, with the flow removed by hand.
TEST_CASE("Shear observables: distributions of velocities, a probe and paths") {
  const Scene scene = sheared_gas(30, 0.8, 1.5);
  Measure measure = scene.measure;
  measure.burn_in = 0.0;
  measure.observables = {ObservableKind::VelocityDistribution, ObservableKind::Probe,
                         ObservableKind::FreeFlights};
  measure.probe.region = {.lower = VecX(Vec2(0.0, 0.0)), .upper = VecX(Vec2(14.0, 9.0))};
  const auto simulation = simulation_of<2>(scene, 6);
  Measurement<2> measurement(*simulation, measure, 100.0);
  Paths paths;
  const Observation<2> observation(*simulation, paths);
  double temperature = 0.0;
  constexpr int kSteps = 20000;
  for (int step = 1; step <= kSteps; ++step) {
    simulation->run_until((step - 0.5) * 100.0 / kSteps);
    State<2> state = simulation->state();
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      state.velocities[i].x() -= 1.5 * (state.positions[i].y() - 4.5);
      mean += state.velocities[i] / 30.0;
      paths.since[i] += state.velocities[i].norm() * 100.0 / kSteps;
    }
    for (const Vec2& c : state.velocities) {
      temperature += (c - mean).squaredNorm() / (2.0 * 29.0) / kSteps;
    }
  }
  simulation->run_until(100.0);
  const Measured measured = measurement.result();
  // 100 samples of a temperature that fluctuates by 1/sqrt(30) and is correlated in time.
  CHECK(errors_off(mean_of(measured, "probe.temperature"), temperature) < 5.0);
  CHECK(errors_off(mean_of(measured, "probe.velocity_x"), 0.0) < 5.0);
  CHECK(mean_of(measured, "probe.velocity_x").standard_error < 0.1);
  // A path of 100 steps has an error of a step; the mean of 10^4 has less.
  const double path = std::accumulate(paths.whole.begin(), paths.whole.end(), 0.0);
  CHECK(mean_of(measured, "free_flights.mean_path").mean ==
        doctest::Approx(path / static_cast<double>(paths.whole.size())).epsilon(1e-3));
  // Equal temperatures along x and y would make both second moments 1.
  const double x = mean_of(measured, "velocity_distribution.second_moment_x").mean;
  const double y = mean_of(measured, "velocity_distribution.second_moment_y").mean;
  CHECK(x / y ==
        doctest::Approx(measured.axis_temperatures[0].mean / measured.axis_temperatures[1].mean)
            .epsilon(0.05));
}

// Pairs of all disks within 3 diameters through any image, in 30 states.
TEST_CASE("Shear observables: distances reach across the sliding border") {
  const Scene scene = sheared_gas(30, 0.9, 1.5);
  Measure measure = scene.measure;
  measure.burn_in = 0.0;
  measure.observables = {ObservableKind::RadialDistribution, ObservableKind::Clusters};
  measure.radial_distribution = {.range = 3.0, .bins = 4};
  measure.clusters = {.range = 1.5};
  const auto simulation = simulation_of<2>(scene, 7);
  Measurement<2> measurement(*simulation, measure, 30.0);
  std::vector<double> counts(4);
  double clusters = 0.0;
  for (int t = 1; t <= 30; ++t) {
    simulation->run_until(t);
    const std::vector<Vec2> positions = simulation->positions();
    const double offset = std::remainder(1.5 * 9.0 * t, 14.0);
    std::vector<int> label(30);
    for (int i = 0; i < 30; ++i) label[static_cast<std::size_t>(i)] = i;
    for (std::size_t i = 0; i < 30; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (const double up : {-1.0, 0.0, 1.0}) {
          Vec2 apart = positions[i] - positions[j] - up * Vec2(offset, 9.0);
          apart.x() = std::remainder(apart.x(), 14.0);
          const double distance = apart.norm();
          if (distance >= 1.0 && distance < 3.0)
            counts[static_cast<std::size_t>((distance - 1.0) * 2.0)] += 1.0;
          if (distance < 1.5) std::ranges::replace(label, int{label[i]}, int{label[j]});
        }
      }
    }
    std::ranges::sort(label);
    clusters += static_cast<double>(std::unique(label.begin(), label.end()) - label.begin()) / 30.0;
  }
  const Measured measured = measurement.result();
  const TableColumn g = column_of(table_of(measured, "radial_distribution"), "g");
  for (int bin = 0; bin < 4; ++bin) {
    const double low = 1.0 + 0.5 * bin, high = low + 0.5;
    const double area = std::numbers::pi * (high * high - low * low);
    const double expected = 30.0 * 0.5 * 30.0 * 29.0 * area / (14.0 * 9.0);
    CHECK(g.values[static_cast<std::size_t>(bin)] ==
          doctest::Approx(counts[static_cast<std::size_t>(bin)] / expected));
  }
  CHECK(mean_of(measured, "clusters.number").mean == doctest::Approx(clusters));
}

}  // namespace clatter::shear_observables
