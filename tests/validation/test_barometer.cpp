#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/measure/cell_integrals.h"
#include "engine/measure/fields.h"
#include "engine/measure/totals.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

// Elastic particles under gravity between a thermal floor and an elastic lid: canonical equilibrium
// at T_w. All results are known, exactly or from the equation of state.

namespace {

constexpr double kTemperature = 2.0;

// The floor and the lid are at the ends of y.
Scene column(const VecX& box, int count, double gravity) {
  Scene scene = gas(box, count, 1.0);
  scene.walls[kBottom] = {.kind = WallKind::Thermal, .temperature = kTemperature};
  scene.walls[kTop] = Wall{};
  scene.gravity = VecX::Zero(box.size());
  (*scene.gravity)[1] = -gravity;
  scene.particles.start.temperature = kTemperature;
  return scene;
}

// The density at a given `potential`: ln rho + 2 B_2 rho + g y/T is the same at all heights. The
// third virial coefficient changes a density of .015 disks by a relative 1e-3.
double virial_density(double potential, double second_virial) {
  double rho = std::exp(potential);
  for (int step = 0; step < 50; ++step) {
    rho -=
        (std::log(rho) + 2.0 * second_virial * rho - potential) / (1.0 / rho + 2.0 * second_virial);
  }
  return rho;
}

// Mean densities of equal layers, by Simpson's rule. The constant of the barometric law gives
// `total` particles per size of the floor.
std::vector<double> virial_layers(int layers, double thickness, double slope, double total,
                                  double second_virial) {
  const auto layer = [&](double constant, int i) {
    const auto at = [&](double y) { return virial_density(constant - slope * y, second_virial); };
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

// A gas in layers of one diameter, averaged over a time window.
struct Layers {
  std::vector<double> pressure;  // -sigma_yy, mean over each layer
  std::vector<double> weight;    // weight of the gas above, per width, mean over each layer
};

// The density is measured in sub-layers. A particle adds weight to a layer by its share below the
// particle.
Layers layers_of(const CellSums& stress, const MomentLayout<2>& stress_layout,
                 const CellSums& density, const MomentLayout<2>& density_layout, double width,
                 double gravity) {
  const std::size_t count = stress.rows.size() / static_cast<std::size_t>(stress_layout.size);
  const std::size_t parts = density.rows.size() / count;
  const double part = 1.0 / static_cast<double>(parts);
  Layers layers{std::vector<double>(count), std::vector<double>(count)};
  double above = 0.0;
  for (std::size_t i = count; i-- > 0;) {
    const auto averages = averages_of(stress_layout, stress, i, width);
    layers.pressure[i] = -field_value(Field(Quantity::Stress, 1, 1), averages);
    layers.weight[i] = above;
    for (std::size_t k = 0; k < parts; ++k) {
      const double rho = averages_of(density_layout, density, i * parts + k, width * part).density;
      const double weight = gravity * rho * part;
      layers.weight[i] += weight * (static_cast<double>(k) + 0.5) * part;
      above += weight;
    }
  }
  return layers;
}

// The difference of the pressures on floor and lid is the weight. The standard error is at most 2
// %.
void check_weight(const VecX& box, int count, double gravity, double duration, std::uint64_t seed) {
  const Measured result = run(column(box, count, gravity), 100.0, duration, seed);
  const Estimate& floor = *result.pressure[kBottom];
  const Estimate& lid = *result.pressure[kTop];
  const double size = box.prod() / box[1];
  const double weight = count * gravity / size;
  const double error = std::hypot(floor.standard_error, lid.standard_error);
  MESSAGE("pressures ", floor.mean, " and ", lid.mean, ", difference ", floor.mean - lid.mean,
          " +- ", error, ", weight per size ", weight);
  CHECK(error < 0.02 * weight);
  CHECK(std::fabs(floor.mean - lid.mean - weight) < 5.0 * error);
  // The remainder is the change of momentum from start to end: variance 2 N T, 5 standard errors.
  CHECK(std::fabs(floor.mean - lid.mean - weight) * size * result.duration <
        5.0 * std::sqrt(2.0 * count * kTemperature));
  MESSAGE("T = ", result.temperature.mean, " +- ", result.temperature.standard_error);
  CHECK(relative_error(result.temperature) < 0.006);
  CHECK(std::fabs(relative(result.temperature, kTemperature)) < 0.015);
  CHECK(std::fabs(result.walls_in->mean) < 5.0 * result.walls_in->standard_error);
  check_energy_balance(result, count);
}

// T/g = 20. Layers with less than one particle on average are omitted, of 16 layers of height 10.
// Layers begin at the lowest centres, y = 1/2: the lowest half diameter above the floor has none.
// Samples every 100: almost three times the time of a bounce, with enough collisions for mixing.
template <int D>
void check_profile(const Vec<D>& box, int count, int windows, std::uint64_t seed) {
  constexpr int kLayers = 16;
  constexpr double kGravity = 0.1;
  const Scene scene = column(box, count, kGravity);
  Simulation<D> simulation(model_of<D>(scene, seed), start_state<D>(scene, seed));
  std::vector<Sample> densities(kLayers), temperatures(kLayers);
  const double size = box.prod() / box[1];
  for (int window = -20; window < windows; ++window) {
    simulation.run_until(100.0 * (window + 21));
    if (window < 0) continue;
    const State<D> state = simulation.state();
    std::vector<double> counts(kLayers);
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const auto layer = static_cast<std::size_t>((state.positions[i].y() - 0.5) / 10.0);
      counts[layer] += 1.0;
      temperatures[layer].add(state.velocities[i].squaredNorm() / D);
    }
    for (std::size_t k = 0; k < kLayers; ++k) densities[k].add(counts[k] / (size * 10.0));
  }
  const double second_virial = D == 2 ? std::numbers::pi / 2.0 : 2.0 * std::numbers::pi / 3.0;
  const auto expected =
      virial_layers(kLayers, 10.0, kGravity / kTemperature, count / size, second_virial);
  for (std::size_t k = 0; k < 8; ++k) {
    const Sample &density = densities[k], &temperature = temperatures[k];
    MESSAGE("layer ", k, ": rho = ", density.mean(), " +- ", density.standard_error(), ", law ",
            expected[k], "; T = ", temperature.mean(), " +- ", temperature.standard_error());
    CHECK(std::fabs(density.mean() - expected[k]) < 5.0 * density.standard_error());
    CHECK(std::fabs(temperature.mean() - kTemperature) < 5.0 * temperature.standard_error());
  }
}

}  // namespace

TEST_CASE("Barometer: the height of one particle on a thermal floor is exponentially distributed") {
  // The height above the floor in units of T/g is exponential with mean 1. The particle never meets
  // the lid at 40 of these (e^-40). Bounces take 2.5 sqrt(T)/g on average. Samples every 40
  // sqrt(T)/g are independent: a bounce of this length has the probability e^-200. 40 bins of equal
  // probability.
  constexpr int kSamples = 20000;
  constexpr int kBins = 40;
  constexpr double kGravity = 0.5;
  const Scene scene = column(Vec2(10.0, 160.0), 1, kGravity);
  Simulation<2> simulation(model_of<2>(scene, 401), start_state<2>(scene, 401));
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
  CHECK(p > kMinProbability);
  CHECK(p_speeds > kMinProbability);
  for (const double count : counts) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
  for (const double count : speeds) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
  CHECK(std::fabs(off) < 5.0);
  CHECK(simulation.counts().pair_collisions == 0);
}

TEST_CASE("Barometer: one particle has the temperature of the floor and presses with its weight") {
  const Scene scene = column(Vec2(10.0, 160.0), 1, 0.5);
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

TEST_CASE("Barometer: a dense gas presses on the floor with its weight, and has its temperature") {
  // 120 disks in 15 x 15 (phi = .42), g Ly = 3.75 T.
  check_weight(Vec2(15.0, 15.0), 120, 0.5, 4000.0, 403);
}

TEST_CASE("Barometer: dense spheres press on the floor with their weight") {
  // 300 spheres in 7 x 8 x 7.5 (phi = .37), g Ly = 4 T.
  check_weight(Vec<3>(7.0, 8.0, 7.5), 300, 1.0, 600.0, 406);
}

TEST_CASE("Barometer: a thin gas has the barometric profile at one temperature") {
  // 100 disks in a width of 200, T/g = 20: rho = .025 at the floor, and e^-8 times smaller at the
  // lid. The two virial coefficients of the law change a layer by up to 8 %, the next one by .3 %.
  check_profile<2>(Vec2(200.0, 160.5), 100, 400, 404);
}

TEST_CASE("Barometer: thin spheres have the barometric profile at one temperature") {
  // 200 spheres over a floor of 24 x 25, T/g = 20: rho = .017 at the floor. The second virial
  // coefficient changes a layer by up to 7 %, the next one by .2 %.
  check_profile<3>(Vec<3>(24.0, 160.5, 25.0), 200, 200, 407);
}

TEST_CASE("Barometer: the stress of every layer carries the weight above it") {
  // dp/dy = -rho g. 160 particles in a width of 20, T/g = 10: phi falls from 0.3 at the floor to
  // 0.04 below the lid, at a height of 4 T/g. 150 windows of 100 time units, 100 apart: the
  // momentum of a layer decorrelates within some collisions, the oscillation of the column more
  // slowly. Densities are in sub-layers of 1/16. Near the floor, where the gas is layered, they
  // neglect about 1e-4 of the weight within a layer.
  constexpr int kLayers = 40;
  constexpr int kParts = 16;
  constexpr int kWindows = 150;
  constexpr double kSpan = 100.0;
  constexpr double kWidth = 20.0;
  constexpr double kGravity = 0.2;
  const Scene scene = column(Vec2(kWidth, kLayers), 160, kGravity);
  Simulation<2> simulation(model_of<2>(scene, 405), start_state<2>(scene, 405));
  const Field stress = Field(Quantity::Stress, 1, 1), density = Quantity::Density;
  CellIntegrals<2> stresses(simulation, {1, kLayers}, moment_layout<2>({&stress, 1}, false, false));
  CellIntegrals<2> densities(simulation, {1, kParts * kLayers},
                             moment_layout<2>({&density, 1}, false, false));
  Totals<2> totals(simulation);
  simulation.add_observer(stresses);
  simulation.add_observer(densities);
  simulation.add_observer(totals);
  // For each layer: its pressure minus the pressure on the lid and the weight above. Also the same
  // difference from layer to layer.
  std::vector<Sample> excesses(kLayers), steps(kLayers), pressures(kLayers), weights(kLayers);
  for (int window = 0; window < kWindows; ++window) {
    simulation.run_until(simulation.time() + kSpan);
    totals.close_window();
    stresses.close_window();
    densities.close_window();
    simulation.run_until(simulation.time() + kSpan);
    const double lid = totals.close_window().wall_impulse[kTop] / (kSpan * kWidth);
    const Layers layers = layers_of(stresses.close_window(), stresses.layout(),
                                    densities.close_window(), densities.layout(), kWidth, kGravity);
    double below = 0.0;
    for (std::size_t i = 0; i < kLayers; ++i) {
      const double excess = layers.pressure[i] - layers.weight[i] - lid;
      excesses[i].add(excess);
      if (i > 0) steps[i].add(excess - below);
      pressures[i].add(layers.pressure[i]);
      weights[i].add(layers.weight[i]);
      below = excess;
    }
  }
  // A step concerns the particles of two layers. Every second step is independent.
  double chi_squared = 0.0, least = 1.0, most = 0.0;
  for (std::size_t i = 0; i < kLayers; ++i) {
    CAPTURE(i);
    CHECK(std::fabs(excesses[i].mean()) < 5.0 * excesses[i].standard_error());
    if (i == 0) continue;
    const double error = steps[i].standard_error();
    CHECK(std::fabs(steps[i].mean()) < 5.0 * error);
    if (i % 2 == 1) chi_squared += std::pow(steps[i].mean() / error, 2);
    const double precision = error / (weights[i - 1].mean() - weights[i].mean());
    least = std::min(least, precision);
    most = std::max(most, precision);
  }
  const double p = chi_squared_p(chi_squared, kLayers / 2);
  MESSAGE("-sigma_yy from ", pressures.front().mean(), " to ", pressures.back().mean(),
          "; dp/dy = -rho g in every layer within ", least, " to ", most, " of it, p = ", p);
  CHECK(p > kMinProbability);
  CHECK(most < 0.02);
}
