#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/initial/start_state.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene between(double left, double right) {
  Scene scene = gas(20.0, 15.0, 80, 1.0);
  scene.walls[kLeft] = {.kind = WallKind::Thermal, .temperature = left};
  scene.walls[kRight] = {.kind = WallKind::Thermal, .temperature = right};
  scene.particles.start.temperature = 0.5 * (left + right);
  scene.measure.fields = {Quantity::Density, Field(Quantity::Temperature, 0),
                          Field(Quantity::Temperature, 1)};
  scene.measure.cells = {5, 1};
  return scene;
}

// Dense elastic particles, smooth or perfectly rough, between four walls of one temperature.
Scene thermal_box(double temperature, bool rough) {
  Scene scene = gas(15.0, 12.0, 60, 1.0);
  for (const int axis : {0, 1}) {
    wall_in(scene, axis, {.kind = WallKind::Thermal, .temperature = temperature});
  }
  if (rough) scene.particles.roughness = {std::numeric_limits<double>::infinity(), 1.0};
  scene.particles.start.temperature = 0.5 * temperature;  // relaxes during the burn-in
  return scene;
}

// Histograms of velocities before and after hits of thermal walls, in bins of equal probability.
class WallSpeeds : public Observer<2> {
 public:
  static constexpr int kBins = 20;
  static constexpr int kEvery =
      7;  // hits; of 60 particles, so that one counts rarely twice in a row

  WallSpeeds(double temperature, double inertia)
      : temperature_(temperature), moment_of_inertia_(0.25 * inertia) {
    for (auto& counts : counts_) counts.assign(kBins, 0.0);
  }

  void on_wall(const WallCollision<2>& hit) override {
    if (++hits_ % kEvery != 0) return;
    const ParticleChange<2>& particle = hit.particle;
    const Vec2 after = particle.velocity + particle.gain.momentum;
    const int normal = hit.side / 2;
    count_flux(0, particle.velocity[normal]);
    count_flux(1, after[normal]);
    count_gaussian(2, particle.velocity[1 - normal]);
    count_gaussian(3, after[1 - normal]);
    count_gaussian(4, std::sqrt(moment_of_inertia_) * particle.spin[0]);
    count_gaussian(5, std::sqrt(moment_of_inertia_) * (particle.spin + particle.gain.spin)[0]);
  }

  double hits() const { return static_cast<double>(hits_ / kEvery); }
  const std::vector<double>& counts(int kind) const { return counts_[kind]; }

 private:
  void count(int kind, double uniform) {
    counts_[kind][static_cast<std::size_t>(std::min(uniform * kBins, kBins - 1.0))] += 1.0;
  }
  // Density (v/T) exp(-v^2/2T).
  void count_flux(int kind, double v) { count(kind, std::exp(-0.5 * v * v / temperature_)); }
  void count_gaussian(int kind, double v) {
    count(kind, 0.5 * std::erfc(v / std::sqrt(2.0 * temperature_)));
  }

  double temperature_;
  double moment_of_inertia_;
  std::uint64_t hits_ = 0;
  std::vector<double> counts_[6];
};

}  // namespace

TEST_CASE("Thermal walls: a gas between two of one temperature takes it") {
  constexpr double kTemperature = 2.0;
  Scene scene = between(kTemperature, kTemperature);
  scene.particles.start.temperature = 0.5;  // relaxes during the burn-in
  const Measured result = run(scene, 300.0, 30000.0, 121);
  MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error, ", walls ",
          kTemperature);
  CHECK(relative_error(result.temperature) < 0.003);
  CHECK(std::fabs(relative(result.temperature, kTemperature)) < 0.01);
  // Canonical ensemble: each component is Gaussian, uniform in space, without the 1/N of a fixed
  // energy.
  for (const Estimate& kurtosis : {result.kurtosis_excess[0], result.kurtosis_excess[1]}) {
    CHECK(kurtosis.standard_error < 0.02);
    CHECK(std::fabs(kurtosis.mean) < 3.0 * kurtosis.standard_error);
  }
  for (const auto* component : {&result.profile->at(Field(Quantity::Temperature, 0)),
                                &result.profile->at(Field(Quantity::Temperature, 1))}) {
    for (const Estimate& local : *component) {
      CHECK(std::fabs(local.mean - kTemperature) < 5.0 * local.standard_error);
    }
  }
  // In equilibrium the mean energy from the walls is zero.
  CHECK(std::fabs(result.walls_in->mean) < 3.0 * result.walls_in->standard_error);
}

TEST_CASE("Thermal walls: heat flows from the hot one to the cold one, matter does not") {
  const Measured result = run(between(3.0, 1.0), 200.0, 10000.0, 122);
  const auto& profile = *result.profile;
  for (std::size_t i = 0; i + 1 < profile.at(Quantity::Density).size(); ++i) {
    CAPTURE(i);
    CHECK(profile.at(Field(Quantity::Temperature, 0))[i].mean >
          profile.at(Field(Quantity::Temperature, 0))[i + 1].mean);
    CHECK(profile.at(Field(Quantity::Temperature, 1))[i].mean >
          profile.at(Field(Quantity::Temperature, 1))[i + 1].mean);
    CHECK(profile.at(Quantity::Density)[i].mean < profile.at(Quantity::Density)[i + 1].mean);
  }
  // Both walls have the same pressure. The energy from one wall goes into the other.
  const Estimate& left = *result.pressure[kLeft];
  const Estimate& right = *result.pressure[kRight];
  const double error = std::hypot(left.standard_error, right.standard_error);
  MESSAGE("pressures ", left.mean, " and ", right.mean, " +- ", error);
  CHECK(error < 0.01 * left.mean);
  CHECK(std::fabs(left.mean - right.mean) < 3.0 * error);
  MESSAGE("walls in = ", result.walls_in->mean, " +- ", result.walls_in->standard_error);
  CHECK(std::fabs(result.walls_in->mean) < 3.0 * result.walls_in->standard_error);
}

TEST_CASE("Thermal walls: a gas among four takes their temperature, in motion and in spin") {
  // alpha = beta = 1 conserves energy. The spins therefore have T_w too.
  constexpr double kTemperature = 2.0;
  for (const bool rough : {false, true}) {
    CAPTURE(rough);
    const Measured result =
        run(thermal_box(kTemperature, rough), 100.0, 12000.0, rough ? 124 : 123);
    MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error);
    CHECK(relative_error(result.temperature) < 0.003);
    CHECK(std::fabs(relative(result.temperature, kTemperature)) < 0.01);
    for (const Estimate& kurtosis : {result.kurtosis_excess[0], result.kurtosis_excess[1]}) {
      CHECK(kurtosis.standard_error < 0.02);
      CHECK(std::fabs(kurtosis.mean) < 5.0 * kurtosis.standard_error);
    }
    CHECK(std::fabs(result.walls_in->mean) < 3.0 * result.walls_in->standard_error);
    check_energy_balance(result, 60);
    REQUIRE(result.spin_temperature.has_value() == rough);
    if (!rough) continue;
    const Estimate& spin = *result.spin_temperature;
    MESSAGE("T_rot = ", spin.mean, " +- ", spin.standard_error);
    CHECK(relative_error(spin) < 0.003);
    CHECK(std::fabs(relative(spin, kTemperature)) < 0.01);
  }
}

TEST_CASE("Thermal walls: arriving particles are distributed like leaving ones") {
  // Detailed balance: normal velocities are flux-weighted; tangential velocities and spins are
  // Gaussian, before and after a hit. Every seventh of some 20,000 hits; 6 distributions.
  constexpr double kTemperature = 2.0;
  const Scene scene = thermal_box(kTemperature, true);
  Simulation<2> simulation(model_of<2>(scene, 125), start_state<2>(scene, 125));
  simulation.run_until(100.0);
  WallSpeeds speeds(kTemperature, scene.particles.inertia);
  simulation.add_observer(speeds);
  simulation.run_until(8000.0);
  const double mean = speeds.hits() / WallSpeeds::kBins;
  CHECK(mean > 1000.0);
  for (int kind = 0; kind < 6; ++kind) {
    const double p = counts_p(speeds.counts(kind), std::vector(WallSpeeds::kBins, mean));
    MESSAGE("law ", kind, ": p = ", p, " of ", speeds.hits(), " hits");
    CHECK(p > kMinProbability);
    for (const double count : speeds.counts(kind)) {
      CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
    }
  }
}
