// Observables of particles of several sizes and masses.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/initial/mixture_state.h"
#include "engine/physics/mixture_theory.h"
#include "tests/engine/observables/observed.h"
#include "tests/engine/support/gas.h"

namespace clatter::mixture_observables {

using namespace testing;

namespace {

/// The results of one observable of a run from a state.
template <int D>
Measured measured_of(const Model<D>& model, const State<D>& state, ObservableKind kind,
                     double duration, Measure measure = {}) {
  measure.burn_in = 0.0;
  measure.cells.assign(D, 1);
  measure.observables = {kind};
  Simulation<D> simulation(model, state);
  Measurement<D> measurement(simulation, measure, duration);
  simulation.run_until(duration);
  return measurement.result();
}

/// Elastic particles of three masses and sizes in a periodic box.
template <int D>
Model<D> elastic_mixture() {
  Model<D> model;
  model.box = D == 2 ? Vec<D>::Constant(9.0) : Vec<D>::Constant(6.0);
  model.species = SpeciesLaws<D>{.pairs = std::vector<PairLaw>(9), .walls = {{}, {}, {}}};
  return model;
}

}  // namespace

TEST_CASE_TEMPLATE("Mixture observables: the probe has the T and the velocity of its masses",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = elastic_mixture<D>();
  const State<D> start = mixed_gas(model, 30, 71, 2.0);
  Measure measure;
  measure.probe.interval = 5.0;
  measure.probe.region = {.lower = VecX(VecX::Zero(D)), .upper = VecX(model.box)};
  measure.probe.region.upper.value()[0] = 0.6 * model.box[0];
  const Measured result = measured_of(model, start, ObservableKind::Probe, 5.0, measure);
  Simulation<D> again(model, start);
  again.run_until(5.0);
  const State<D> state = again.state();
  double mass = 0.0, number = 0.0, squares = 0.0;
  Vec<D> momentum = Vec<D>::Zero();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    if (state.positions[i][0] >= 0.6 * model.box[0]) continue;
    number += 1.0;
    mass += state.grains[i].mass;
    momentum += state.grains[i].mass * state.velocities[i];
    squares += state.grains[i].mass * state.velocities[i].squaredNorm();
  }
  squares -= momentum.squaredNorm() / mass;
  REQUIRE(number > 3.0);
  CHECK(mean_of(result, "probe.temperature").mean ==
        doctest::Approx(squares / (D * (number - 1.0))).epsilon(1e-10));
  CHECK(mean_of(result, "probe.velocity_x").mean ==
        doctest::Approx(momentum[0] / mass).epsilon(1e-10));
}

// Disks of diameters 3, 1, 1 and 1 in a row, at rest: gaps of 0.35, 0.25 and 0.15. At a range of
// 1.2 contacts may be 0.4, 0.2 and 0.2 apart.
TEST_CASE("Mixture observables: clusters connect by the distance at contact of each pair") {
  Model<2> model = elastic_mixture<2>();
  model.box = Vec2(20.0, 20.0);
  model.diameter = 3.0;
  State<2> state{{{4.0, 10.0}, {6.35, 10.0}, {7.6, 10.0}, {8.75, 10.0}},
                 std::vector<Vec2>(4, Vec2::Zero())};
  state.grains.assign(4, {});
  state.grains[0].radius = 1.5;
  const Measured result = measured_of(model, state, ObservableKind::Clusters, 2.0);
  CHECK(mean_of(result, "clusters.number").mean == 2.0);
  CHECK(mean_of(result, "clusters.largest").mean == 2.0);
  Measure measure;
  measure.clusters.range = 1.3;
  CHECK(
      mean_of(measured_of(model, state, ObservableKind::Clusters, 2.0, measure), "clusters.number")
          .mean == 1.0);
}

// A disk of diameter 3 among six of diameter 1 that touch it nearly, at rest. The neighbours of
// the small ones are the large one only: |psi_6| of all disks is 1.
TEST_CASE("Mixture observables: bonds are between particles near contact") {
  Model<2> model = elastic_mixture<2>();
  model.box = Vec2(20.0, 20.0);
  model.diameter = 3.0;
  State<2> state{{{10.0, 10.0}}, std::vector<Vec2>(7, Vec2::Zero())};
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3.0;
    state.positions.push_back(Vec2(10.0, 10.0) + 2.2 * Vec2(std::cos(angle), std::sin(angle)));
  }
  state.grains.assign(7, {});
  state.grains[0].radius = 1.5;
  const Measured result = measured_of(model, state, ObservableKind::BondOrder, 2.0);
  CHECK(mean_of(result, "bond_order.local").mean == doctest::Approx(1.0).epsilon(1e-12));
}

// In equilibrium every component is Gaussian for each mass. 4000 samples of 12 particles of masses
// 1, 0.5 and 6, so that the heavy ones have 80 % of the mass; 5 standard errors.
TEST_CASE_TEMPLATE("Mixture observables: an elastic gas has the moments of Gaussian velocities",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = elastic_mixture<D>();
  std::vector<Grain> grains(12);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (i % 3 == 1) grains[i] = {.radius = 0.4, .mass = 0.5, .species = 1};
    if (i % 3 == 2) grains[i] = {.radius = 0.45, .mass = 6.0, .species = 2};
  }
  Measure measure;
  measure.velocity_distribution.interval = 2.0;
  const Measured result = measured_of(model, mixture_state<D>(model, grains, 1.0, 72),
                                      ObservableKind::VelocityDistribution, 8000.0, measure);
  const auto check = [&](const char* name, double value, double precision) {
    const Estimate found = mean_of(result, std::string("velocity_distribution.") + name);
    CAPTURE(name);
    CAPTURE(found.mean);
    CHECK(found.standard_error < precision);
    CHECK(std::fabs(found.mean - value) < 5.0 * found.standard_error);
  };
  check("second_moment_x", 1.0, 0.03);
  check("fourth_moment_x", 3.0, 0.15);
  check("a2", 0.0, 0.03);
  check("a3", 0.0, 0.05);
}

// Spins of a rough elastic gas: those of all moments of inertia are Gaussian in units of their own
// thermal spin. 2000 samples of 12 particles, 5 standard errors.
TEST_CASE("Mixture observables: spins of all species have the kurtosis of a Gaussian") {
  Model<2> model = rough(elastic_mixture<2>(), kInfinity, 1.0);
  model.species->pairs.assign(9, {1.0, {kInfinity, 1.0}});
  std::vector<Grain> grains(12);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (i % 3 == 1) grains[i] = {.radius = 0.3, .mass = 0.5, .inertia = 0.3, .species = 1};
    if (i % 3 == 2) grains[i] = {.radius = 0.45, .mass = 3.0, .species = 2};
  }
  State<2> start = mixture_state<2>(model, grains, 1.0, 73);
  start.spins.assign(12, Spin<2>(Spin<2>::Zero()));
  start.spins[0][0] = 1.0;
  Measure measure;
  measure.burn_in = 0.0;
  measure.spin_distribution.interval = 2.0;
  const Measured result =
      measured_of(model, start, ObservableKind::SpinDistribution, 4000.0, measure);
  const Estimate kurtosis = mean_of(result, "spin_distribution.kurtosis");
  CAPTURE(kurtosis.mean);
  CHECK(kurtosis.standard_error < 0.1);
  CHECK(std::fabs(kurtosis.mean - 3.0) < 5.0 * kurtosis.standard_error);
}

namespace {

/// All pairs of a state by distance, from the nearest image.
template <int D>
std::vector<double> pairs_of(const Model<D>& model, const State<D>& state, std::uint32_t first,
                             std::uint32_t second, double low, double width, std::size_t bins) {
  std::vector<double> counts(bins, 0.0);
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto [a, b] = std::minmax(state.grains[i].species, state.grains[j].species);
      if (a != first || b != second) continue;
      Vec<D> x = state.positions[i] - state.positions[j];
      for (int axis = 0; axis < D; ++axis) {
        x[axis] -= model.box[axis] * std::round(x[axis] / model.box[axis]);
      }
      const double bin = (x.norm() - low) / width;
      if (bin < static_cast<double>(bins)) counts[static_cast<std::size_t>(bin)] += 1.0;
    }
  }
  return counts;
}

}  // namespace

TEST_CASE_TEMPLATE("Mixture observables: g of each two species counts their pairs", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = elastic_mixture<D>();
  const State<D> start = mixed_gas(model, 30, 74, 2.0);
  Measure measure;
  measure.radial_distribution = {.interval = 4.0, .range = 2.5, .bins = 10};
  const Measured result =
      measured_of(model, start, ObservableKind::RadialDistribution, 4.0, measure);
  Simulation<D> again(model, start);
  again.run_until(4.0);
  const ResultTable table = table_of(result, "radial_distribution");
  REQUIRE(table.columns.size() == 8);  // r, g and six pairs
  const double low = 0.5, width = 0.2, volume = model.box.prod();
  std::vector<double> all(10, 0.0);
  for (std::uint32_t a = 0; a < 3; ++a) {
    for (std::uint32_t b = a; b < 3; ++b) {
      const std::vector<double> counts = pairs_of(model, again.state(), a, b, low, width, 10);
      const TableColumn g = column_of(table, "g_" + std::to_string(a) + '+' + std::to_string(b));
      for (std::size_t k = 0; k < 10; ++k) {
        const double from = low + width * static_cast<double>(k), to = from + width;
        const double shell =
            D == 2 ? std::numbers::pi * (to * to - from * from)
                   : 4.0 / 3.0 * std::numbers::pi * (to * to * to - from * from * from);
        const double pairs = a == b ? 45.0 : 100.0;
        all[k] += counts[k];
        CHECK(g.values[k] == doctest::Approx(counts[k] * volume / (pairs * shell)).epsilon(1e-9));
        if (a == 2 && b == 2) {
          CHECK(column_of(table, "g").values[k] ==
                doctest::Approx(all[k] * volume / (435.0 * shell)).epsilon(1e-9));
        }
      }
    }
  }
}

// 100 and 50 disks of diameters 1 and 2 at an area fraction of 0.4; 4800 samples. The contact
// values of theory are right within 2 %; standard errors below 3 %, width 4 of them and 2 %.
TEST_CASE("Mixture observables: g at contact is that of theory") {
  Model<2> model;
  model.box.setConstant(std::sqrt(300.0 * std::numbers::pi / 4.0 / 0.4));
  model.diameter = 2.0;
  model.species = SpeciesLaws<2>{.pairs = std::vector<PairLaw>(4), .walls = {{}, {}}};
  std::vector<Grain> grains(100);
  grains.resize(150, {.radius = 1.0, .mass = 4.0, .species = 1});
  MixtureGas theory;
  theory.volume = model.box.prod();
  theory.species = 2;
  theory.components = {{.species = 0, .count = 100.0},
                       {.species = 1, .count = 50.0, .diameter = 2.0, .mass = 4.0}};
  theory.contacts.assign(4, {});
  Measure measure;
  measure.radial_distribution.interval = 0.25;
  const Measured result = measured_of(model, mixture_state<2>(model, grains, 1.0, 75),
                                      ObservableKind::RadialDistribution, 1200.0, measure);
  const std::array<std::pair<const char*, std::array<double, 2>>, 3> pairs = {
      {{"0+0", {1.0, 1.0}}, {"0+1", {1.0, 2.0}}, {"1+1", {2.0, 2.0}}}};
  for (const auto& [name, diameters] : pairs) {
    CAPTURE(name);
    const Estimate found = mean_of(result, std::string("radial_distribution.contact_") + name);
    const double chi = theory.contact_correlation(diameters[0], diameters[1]);
    CAPTURE(found.mean);
    CAPTURE(chi);
    CHECK(found.standard_error < 0.03 * chi);
    CHECK(std::fabs(found.mean - chi) < 4.0 * found.standard_error + 0.02 * chi);
  }
}

// Distances near contact reach 0.2 smallest diameters beyond it.
TEST_CASE("Mixture observables: only distances within the range give a value at contact") {
  const Model<2> model = elastic_mixture<2>();
  const State<2> start = mixed_gas(model, 30, 74, 2.0);
  double largest = 0.0, smallest = 1.0;
  std::string species;
  for (const Grain& grain : start.grains) {
    if (2.0 * grain.radius > largest) species = std::to_string(grain.species);
    largest = std::max(largest, 2.0 * grain.radius);
    smallest = std::min(smallest, 2.0 * grain.radius);
  }
  const std::string name = "radial_distribution.contact_" + species + '+' + species;
  const auto has = [&](double range) {
    Measure measure;
    measure.radial_distribution = {.interval = 4.0, .range = range, .bins = 10};
    const Measured result =
        measured_of(model, start, ObservableKind::RadialDistribution, 4.0, measure);
    return std::ranges::any_of(result.observables.at(0).means,
                               [&](const auto& mean) { return mean.first == name; });
  };
  CHECK_FALSE(has(largest + 0.19 * smallest));
  CHECK(has(largest + 0.21 * smallest));
}

TEST_CASE("Mixture observables: velocities leave out species without particles") {
  Model<2> model = elastic_mixture<2>();
  State<2> start = mixed_gas(model, 30, 77, 2.0);
  for (Grain& grain : start.grains) grain.species = grain.species == 1 ? 0 : grain.species;
  Measure measure;
  measure.velocity_distribution = {.interval = 4.0, .range = 4.0, .bins = 4};
  const Measured result =
      measured_of(model, start, ObservableKind::VelocityDistribution, 4.0, measure);
  CHECK(table_of(result, "velocity_distribution").columns.size() == 2 + 2 * 3);
  for (const auto& [name, mean] : result.observables.at(0).means) CHECK_FALSE(name.ends_with("_1"));
}

TEST_CASE_TEMPLATE("Mixture observables: correlations in time of each species", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = elastic_mixture<D>();
  const State<D> start = mixed_gas(model, 30, 76, 2.0);
  Measure measure;
  measure.velocity_autocorrelation = {.interval = 0.4, .longest = 0.8, .lags = 2};
  measure.mean_squared_displacement = {.interval = 0.4, .longest = 0.8, .lags = 2};
  // Samples at 0.4, 0.8 and 1.2: one of them is 0.8 after another.
  Simulation<D> again(model, start);
  std::vector<State<D>> states;
  for (int k = 1; k <= 3; ++k) {
    again.run_until(0.4 * k);
    states.push_back(again.state());
  }
  const ResultTable velocities =
      table_of(measured_of(model, start, ObservableKind::VelocityAutocorrelation, 1.2, measure),
               "velocity_autocorrelation");
  const ResultTable places =
      table_of(measured_of(model, start, ObservableKind::MeanSquaredDisplacement, 1.2, measure),
               "mean_squared_displacement");
  REQUIRE(column_of(velocities, "time").values.back() == doctest::Approx(0.8));
  double all = 0.0;
  for (std::uint32_t s = 0; s < 3; ++s) {
    Vec<D> products = Vec<D>::Zero(), squares = Vec<D>::Zero();
    for (std::size_t i = 0; i < 30; ++i) {
      if (start.grains[i].species != s) continue;
      products += states[0].velocities[i].cwiseProduct(states[2].velocities[i]) / 10.0;
      Vec<D> moved = states[2].positions[i] - states[0].positions[i];
      for (int axis = 0; axis < D; ++axis) {
        moved[axis] -= model.box[axis] * std::round(moved[axis] / model.box[axis]);
      }
      squares += moved.cwiseAbs2() / 10.0;
    }
    const std::string name = '_' + std::to_string(s);
    CHECK(column_of(velocities, "x" + name).values.back() ==
          doctest::Approx(products[0]).epsilon(1e-9));
    CHECK(column_of(velocities, "mean" + name).values.back() ==
          doctest::Approx(products.sum() / D).epsilon(1e-9));
    CHECK(column_of(places, "total" + name).values.back() ==
          doctest::Approx(squares.sum()).epsilon(1e-9));
    all += squares.sum() / 3.0;
  }
  CHECK(column_of(places, "total").values.back() == doctest::Approx(all).epsilon(1e-9));
}

// In equilibrium T_s/T is 1 but for the momentum of all, and a2 is 0; see above.
TEST_CASE("Mixture observables: velocities of each species") {
  const Model<2> model = elastic_mixture<2>();
  Measure measure;
  measure.velocity_distribution = {.interval = 4.0, .range = 4.0, .bins = 40};
  const State<2> start = mixed_gas(model, 30, 77, 2.0);
  const Measured once =
      measured_of(model, start, ObservableKind::VelocityDistribution, 4.0, measure);
  Simulation<2> again(model, start);
  again.run_until(4.0);
  const State<2> state = again.state();
  double T = 0.0;
  for (std::size_t i = 0; i < 30; ++i) {
    T += state.grains[i].mass * state.velocities[i].squaredNorm() / 58.0;  // momentum is 0
  }
  const ResultTable table = table_of(once, "velocity_distribution");
  for (std::uint32_t s = 0; s < 3; ++s) {
    std::vector<double> counts(40, 0.0);
    for (std::size_t i = 0; i < 30; ++i) {
      if (state.grains[i].species != s) continue;
      const double u = std::sqrt(state.grains[i].mass / T) * state.velocities[i].y();
      const double bin = std::floor((u + 4.0) / 0.2);
      if (bin >= 0.0 && bin < 40.0) counts[static_cast<std::size_t>(bin)] += 1.0;
    }
    const TableColumn column = column_of(table, "y_" + std::to_string(s));
    for (std::size_t k = 0; k < 40; ++k) {
      CHECK(column.values[k] == doctest::Approx(counts[k] / (10.0 * 0.2)).epsilon(1e-9));
    }
  }
  measure.velocity_distribution.interval = 2.0;
  const Measured result =
      measured_of(model, start, ObservableKind::VelocityDistribution, 4000.0, measure);
  for (const char* name : {"temperature_ratio_0", "temperature_ratio_2", "a2_0", "a2_1", "a2_2"}) {
    const Estimate found = mean_of(result, std::string("velocity_distribution.") + name);
    CAPTURE(name);
    CAPTURE(found.mean);
    CHECK(found.standard_error < 0.02);
    CHECK(std::fabs(found.mean - (name[0] == 't' ? 1.0 : 0.0)) < 5.0 * found.standard_error);
  }
}

// Of one sample: S of all particles is the sum over the pairs of species, and the densities of two
// disks are known.
TEST_CASE("Mixture observables: structure factors of each two species") {
  Model<2> model = elastic_mixture<2>();
  State<2> state{{{1.3, 2.0}, {4.0, 7.1}, {6.4, 3.2}}, std::vector<Vec2>(3, Vec2::Zero())};
  state.grains.assign(3, {.radius = 0.3});
  state.grains[1].species = 1;
  state.grains[2].species = 1;
  Measure measure;
  measure.structure_factor = {.interval = 1.0, .range = 3.0, .bins = 4, .vectors = 1};
  const ResultTable table = table_of(
      measured_of(model, state, ObservableKind::StructureFactor, 1.0, measure), "structure_factor");
  REQUIRE(table.columns.size() == 6);  // species 2 has no particles
  const auto at = [&](const char* name, std::size_t k) { return column_of(table, name).values[k]; };
  for (std::size_t k = 0; k < column_of(table, "k").values.size(); ++k) {
    CHECK(at("S_0+0", k) == doctest::Approx(1.0).epsilon(1e-12));
    const double all =
        (at("S_0+0", k) + 2.0 * at("S_1+1", k)) / 3.0 + 2.0 * std::sqrt(2.0) / 3.0 * at("S_0+1", k);
    CHECK(at("S", k) == doctest::Approx(all).epsilon(1e-10));
  }
  // One of the two shortest wave vectors.
  const double step = 2.0 * std::numbers::pi / 9.0;
  const std::size_t first = 0;
  REQUIRE(at("k", first) == doctest::Approx(step).epsilon(1e-12));
  const auto own = [&](int axis) {
    const double apart = state.positions[1][axis] - state.positions[2][axis];
    return 1.0 + std::cos(step * apart);
  };
  const double found = at("S_1+1", first);
  CHECK(std::min(std::fabs(found - own(0)), std::fabs(found - own(1))) < 1e-10);
}

// Species that differ in name only are at random in equilibrium, whatever the density profile is.
// 2000 samples of 60 particles in 9 cells (3D: 8), 5 standard errors; those of L are below 1 %.
TEST_CASE_TEMPLATE("Mixture observables: names at random have the mixing at random", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = elastic_mixture<D>();
  std::vector<Grain> grains(60);
  for (std::size_t i = 0; i < grains.size(); ++i) grains[i].species = i < 20 ? 0 : 1;
  const State<D> start = mixture_state<D>(model, grains, 1.0, 72);
  Measure measure;
  measure.mixing = {.interval = 2.0, .cell = 3.0};
  const Measured result = measured_of(model, start, ObservableKind::Mixing, 4000.0, measure);
  const Estimate lacey = mean_of(result, "mixing.lacey");
  const Estimate entropy = mean_of(result, "mixing.entropy");
  const Estimate random = mean_of(result, "mixing.random_entropy");
  REQUIRE(lacey.standard_error < 0.01);
  CHECK(std::abs(lacey.mean - 1.0) < 5.0 * lacey.standard_error);
  CHECK(std::abs(entropy.mean - random.mean) < 5.0 * entropy.standard_error);
  CHECK(random.mean < 0.97);
}

// Two species at rest on both sides of x = 4.5, cells of 4.5: one species a cell.
TEST_CASE("Mixture observables: separate species are not mixed, at any time") {
  Model<2> model = elastic_mixture<2>();
  State<2> state{{{1.0, 1.0}, {3.0, 5.0}, {6.0, 2.0}, {8.0, 8.0}, {7.0, 6.0}},
                 std::vector<Vec2>(5, Vec2::Zero())};
  state.grains.assign(5, {});
  for (const std::size_t i : {2, 3, 4}) state.grains[i].species = 2;
  Measure measure;
  measure.mixing = {.interval = 1.0, .cell = 4.5};
  const Measured result = measured_of(model, state, ObservableKind::Mixing, 8.0, measure);
  CHECK(mean_of(result, "mixing.lacey").mean == doctest::Approx(0.0));
  CHECK(mean_of(result, "mixing.entropy").mean == 0.0);
  const ResultTable series = table_of(result, "mixing.series");
  REQUIRE(series.columns[0].name == "time");
  CHECK(series.columns[0].values.back() == doctest::Approx(8.0).epsilon(0.2));
  for (const double lacey : series.columns[1].values) CHECK(std::abs(lacey) < 1e-12);
}

}  // namespace clatter::mixture_observables
