#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/dynamics/start.h"
#include "tests/physics/experiment.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

// Elastic disks under gravity on a thermal floor, below an elastic lid: canonical equilibrium at
// T_w, so that everything is known exactly, or by the equation of state.

namespace {

constexpr double kTemperature = 2.0;

Scene column(double lx, double ly, int count, double gravity) {
  Scene scene = gas(lx, ly, count, 1.0);
  scene.walls[kBottom] = {.kind = WallKind::Thermal, .temperature = kTemperature};
  scene.walls[kTop] = Wall{};
  scene.gravity = Vec2(0.0, -gravity);
  scene.disks.start.temperature = kTemperature;
  return scene;
}

// ln rho + pi rho + g y/T is the same at all heights (second virial coefficient pi/2; the third
// changes a density of .015 by 1e-3 of itself): the density where it is `potential`.
double virial_density(double potential) {
  double rho = std::exp(potential);
  for (int step = 0; step < 50; ++step) {
    rho -= (std::log(rho) + std::numbers::pi * rho - potential) / (1.0 / rho + std::numbers::pi);
  }
  return rho;
}

// Mean densities of equal layers of the given thickness, by Simpson's rule, at the constant of the
// barometric law that gives `total` per area in all.
std::vector<double> virial_layers(int layers, double thickness, double slope, double total) {
  const auto layer = [&](double constant, int i) {
    const auto at = [&](double y) { return virial_density(constant - slope * y); };
    return (at(i * thickness) + 4.0 * at((i + 0.5) * thickness) + at((i + 1) * thickness)) / 6.0;
  };
  double low = -20.0, high = 0.0;
  std::vector<double> densities(static_cast<std::size_t>(layers));
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    double sum = 0.0;
    for (int i = 0; i < layers; ++i) {
      densities[static_cast<std::size_t>(i)] = layer(middle, i);
      sum += thickness * densities[static_cast<std::size_t>(i)];
    }
    (sum > total ? high : low) = middle;
  }
  return densities;
}

}  // namespace

TEST_CASE("barometer: one disk on a thermal floor has the exponential law of height, exactly") {
  // Height above the floor over T/g: exponential of mean 1. The lid at 40 of these is never met
  // (e^-40). Bounces take 2.5 sqrt(T)/g on average; samples every 40 sqrt(T)/g are independent,
  // for a bounce that long has the probability e^-200. 40 bins of equal probability.
  constexpr int kSamples = 20000;
  constexpr int kBins = 40;
  constexpr double kGravity = 0.5;
  const Scene scene = column(10.0, 160.0, 1, kGravity);
  Simulation<2> simulation(model_of(scene, 401), start_state(scene, 401));
  std::vector<double> counts(kBins), speeds(kBins);
  double sum = 0.0;
  const double interval = 40.0 * std::sqrt(kTemperature) / kGravity;
  simulation.every(interval, interval, [&](double) {
    const State<2> state = simulation.state();
    const double height = (state.positions[0].y() - 0.5) * kGravity / kTemperature;
    const double squared = state.velocities[0].squaredNorm() / (2.0 * kTemperature);
    sum += height;
    counts[static_cast<std::size_t>(std::min(std::exp(-height) * kBins, kBins - 1.0))] += 1.0;
    speeds[static_cast<std::size_t>(std::min(std::exp(-squared) * kBins, kBins - 1.0))] += 1.0;
  });
  simulation.run_until((kSamples + 0.5) * interval);
  const double mean = kSamples / static_cast<double>(kBins);
  const double p = counts_p(counts, std::vector(kBins, mean));
  const double p_speeds = counts_p(speeds, std::vector(kBins, mean));
  const double off = standard_errors_off(sum, kSamples, 1.0, 1.0);
  MESSAGE("heights: p = ", p, ", speeds: p = ", p_speeds, ", <y> - 1/2 = ", sum / kSamples,
          " T/g, off by ", off, " standard errors of .7 %");
  CHECK(p > kLeastProbability);
  CHECK(p_speeds > kLeastProbability);
  for (const double count : counts) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
  for (const double count : speeds) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
  CHECK(std::fabs(off) < 5.0);
  CHECK(simulation.counts().disk_disk == 0);
}

TEST_CASE("barometer: averages over time of one disk are those of the law") {
  const Scene scene = column(10.0, 160.0, 1, 0.5);
  const Measured result = run(scene, 100.0, 400000.0, 402);
  MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error, ", pressure ",
          result.pressure[kBottom]->mean, " +- ", result.pressure[kBottom]->standard_error);
  CHECK(relative_error(result.temperature) < 0.005);
  CHECK(std::fabs(result.temperature.mean - kTemperature) <
        5.0 * result.temperature.standard_error);
  CHECK(std::fabs(relative(result.temperature, kTemperature)) < 0.01);
  // The floor bears the weight, g/Lx.
  CHECK(std::fabs(relative(*result.pressure[kBottom], 0.05)) < 1e-4);
  check_energy_balance(result, 1);
}

TEST_CASE("barometer: a dense gas weighs upon the floor what it is, and is at T_w throughout") {
  // 120 disks in 15 x 15 (phi = .42), g Ly = 3.75 T.
  constexpr int kCount = 120;
  constexpr double kGravity = 0.5;
  const Scene scene = column(15.0, 15.0, kCount, kGravity);
  const Measured result = run(scene, 100.0, 4000.0, 403);
  const Estimate& floor = *result.pressure[kBottom];
  const Estimate& lid = *result.pressure[kTop];
  const double weight = kCount * kGravity / 15.0;
  const double error = std::hypot(floor.standard_error, lid.standard_error);
  MESSAGE("pressures ", floor.mean, " and ", lid.mean, ", difference ", floor.mean - lid.mean,
          " +- ", error, ", weight per length ", weight);
  CHECK(error < 0.02 * weight);
  CHECK(std::fabs(floor.mean - lid.mean - weight) < 5.0 * error);
  // The rest is the change of momentum from begin to end: variance 2 N T, 5 standard errors.
  CHECK(std::fabs(floor.mean - lid.mean - weight) * 15.0 * result.duration <
        5.0 * std::sqrt(2.0 * kCount * kTemperature));
  CHECK(relative_error(result.temperature) < 0.006);
  CHECK(std::fabs(relative(result.temperature, kTemperature)) < 0.015);
  CHECK(std::fabs(result.walls_in->mean) < 5.0 * result.walls_in->standard_error);
  check_energy_balance(result, kCount);
}

TEST_CASE("barometer: a thin gas has the barometric profile at one temperature") {
  // 100 disks over 200 wide, T/g = 20: rho = .025 at the floor, 1.5 e^-8 of it at the lid. 16
  // layers of 10; those that hold less than a disk on average are left out. The two virial
  // coefficients of the law change a layer by up to 8 %, the next one by .3 %; the layers next to
  // the floor hold no centres in its lowest half diameter.
  constexpr int kLayers = 16;
  constexpr int kWindows = 400;
  constexpr double kGravity = 0.1;
  constexpr double kCount = 100.0;
  const Scene scene = column(200.0, 160.5, 100, kGravity);
  const Model<2> model = model_of(scene, 404);
  // Layers counted from the lowest centres at y = 1/2, by samples every 100: twice the time of a
  // bounce, and there are enough collisions to mix.
  Simulation<2> simulation(model, start_state(scene, 404));
  std::vector<Sample> densities(kLayers), temperatures(kLayers);
  for (int window = -20; window < kWindows; ++window) {
    simulation.run_until(50.0 * (window + 21));
    if (window < 0) continue;
    const State<2> state = simulation.state();
    std::vector<double> counts(kLayers), squares(kLayers);
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const auto layer = static_cast<std::size_t>((state.positions[i].y() - 0.5) / 10.0);
      counts[layer] += 1.0;
      temperatures[layer].add(0.5 * state.velocities[i].squaredNorm());
    }
    for (std::size_t k = 0; k < kLayers; ++k) densities[k].add(counts[k] / (200.0 * 10.0));
  }
  const auto expected = virial_layers(kLayers, 10.0, kGravity / kTemperature, kCount / 200.0);
  for (std::size_t k = 0; k < 8; ++k) {
    const Sample &density = densities[k], &temperature = temperatures[k];
    MESSAGE("layer ", k, ": rho = ", density.mean(), " +- ", density.standard_error(), ", law ",
            expected[k], "; T = ", temperature.mean(), " +- ", temperature.standard_error());
    CHECK(std::fabs(density.mean() - expected[k]) < 5.0 * density.standard_error());
    CHECK(std::fabs(temperature.mean() - kTemperature) < 5.0 * temperature.standard_error());
  }
}
