#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// A gas of perfectly rough elastic particles, in equilibrium.
template <int D>
Scene rough_gas(int count, double restitution, double tangential) {
  Scene scene = gas(VecX::Constant(D, D == 2 ? 20.0 : 10.0), count, restitution);
  scene.particles.inertia = D == 2 ? 0.5 : 0.4;
  scene.particles.roughness = {.friction = INFINITY, .tangential_restitution = tangential};
  return scene;
}

}  // namespace

// The histograms of one state, counted again.
TEST_CASE_TEMPLATE("Spin distribution: components, kurtosis and angles are those of the state",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  constexpr int kComponents = D == 2 ? 1 : 3;
  constexpr double kTime = 40.0;  // all particles have collided and spin
  Scene scene = rough_gas<D>(60, 0.9, 0.3);
  // Walls, so that the mean velocity is not 0.
  wall_in(scene, 0, {.kind = WallKind::Thermal, .temperature = 1.0});
  Measure measure;
  measure.spin_distribution = {.interval = kTime, .range = 2.5, .bins = 10};
  const Measured measured = observed<D>(scene, measure, ObservableKind::SpinDistribution, kTime, 3);
  const auto simulation = simulation_of<D>(scene, 3);
  simulation->run_until(kTime);
  const State<D> state = simulation->state();
  double squares = 0.0, fourths = 0.0;
  for (const Spin<D>& spin : state.spins) {
    squares += spin.squaredNorm();
    fourths += spin.array().pow(4).sum();
  }
  constexpr double kNumbers = 60.0 * kComponents;
  CHECK(mean_of(measured, "spin_distribution.kurtosis").mean ==
        doctest::Approx((kNumbers + 2.0) * fourths / (squares * squares)).epsilon(1e-12));
  const ResultTable table = table_of(measured, "spin_distribution.components");
  REQUIRE(table.columns.size() == 2 + kComponents);
  const double deviation = std::sqrt(squares / kNumbers);
  for (int axis = 0; axis < kComponents; ++axis) {
    const std::string name = D == 2 ? "density" : std::string(1, "xyz"[axis]);
    std::vector<double> scaled;
    for (const Spin<D>& spin : state.spins) scaled.push_back(spin[axis] / deviation);
    check_density(table, name, scaled);
  }
  for (std::size_t bin = 0; bin < 10; ++bin) {
    const double low = -2.5 + 0.5 * static_cast<double>(bin);
    CHECK(column_of(table, "low").values[bin] == doctest::Approx(low));
    CHECK(column_of(table, "high").values[bin] == doctest::Approx(low + 0.5));
  }
  if constexpr (D == 3) {
    Vec<D> mean = Vec<D>::Zero();
    for (const Vec<D>& velocity : state.velocities) mean += velocity / 60.0;
    const ResultTable angles = table_of(measured, "spin_distribution.cosine");
    std::vector<double> counts(50, 0.0);
    double cosines = 0.0;
    for (std::size_t i = 0; i < 60; ++i) {
      const Vec<D> velocity = state.velocities[i] - mean;
      const double cosine = velocity.normalized().dot(state.spins[i].normalized());
      cosines += cosine * cosine / 60.0;
      counts[static_cast<std::size_t>(std::fabs(cosine) * 50.0)] += 50.0 / 60.0;
    }
    CHECK(mean_of(measured, "spin_distribution.mean_squared_cosine").mean ==
          doctest::Approx(cosines).epsilon(1e-12));
    for (std::size_t bin = 0; bin < 50; ++bin) {
      CHECK(column_of(angles, "density").values[bin] == doctest::Approx(counts[bin]));
    }
  }
}

// In equilibrium spins are uniform on a sphere, in spite of the small number. Sample: 4000 states
// of 40 particles, about a mean free time apart.
TEST_CASE_TEMPLATE("Spin distribution: equilibrium has a kurtosis of 3 and a cosine of 1/3",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = rough_gas<D>(40, 1.0, 1.0);
  Measure measure;
  measure.spin_distribution = {.interval = 2.0, .range = 4.0, .bins = 20};
  const Measured measured =
      observed<D>(scene, measure, ObservableKind::SpinDistribution, 8000.0, 3);
  const Estimate kurtosis = mean_of(measured, "spin_distribution.kurtosis");
  CHECK(kurtosis.standard_error < 0.05);
  CHECK(errors_off(kurtosis, 3.0) < 5.0);
  if constexpr (D == 3) {
    const Estimate cosine = mean_of(measured, "spin_distribution.mean_squared_cosine");
    CHECK(cosine.standard_error < 0.003);
    CHECK(errors_off(cosine, 1.0 / 3.0) < 5.0);
  }
}
