// Fields of each species of a mixture.

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/measure/fields.h"
#include "engine/measure/measurement.h"
#include "tests/engine/measure/scenes.h"
#include "tests/support/dimensions.h"

namespace clatter::species_fields {

using namespace testing;

namespace {

constexpr std::size_t kSpecies = 3;  // of mixed_gas

/// Density, velocity, temperature and drag of the gas and of each species.
template <int D>
std::vector<Field> species_fields() {
  std::vector<Field> fields;
  for (const Quantity quantity :
       {Quantity::Density, Quantity::Velocity, Quantity::Temperature, Quantity::Drag}) {
    for (const Field field : fields_of(quantity, D)) {
      fields.push_back(field);
      for (std::size_t s = 0; s < kSpecies; ++s) fields.push_back(field.of(s));
    }
  }
  return fields;
}

template <int D>
IntVec<D> few_cells() {
  return IntVec<3>(4, 3, 2).head<D>();
}

/// A watched run of a mixture with walls, gravity, kicks and spins.
template <int D>
struct Watched {
  Simulation<D> simulation;
  CellIntegrals<D> cells;

  Watched(std::uint64_t seed, Coarsening coarsening)
      : simulation(with_species(with_contact_time(kicked(everything<D>(), 0.17, 0.1), 0.01)),
                   mixed_gas(everything<D>(), 24, seed, 2.0)),
        cells(simulation, few_cells<D>(),
              moment_layout<D>(species_fields<D>(), simulation.model().spins, true), coarsening) {
    simulation.add_observer(cells);
  }
  double value(const CellSums& sums, std::size_t cell, Field field) const {
    return field_value(
        field, averages_of(cells.layout(), sums, cell, cells.grid().cell_measure(), field.species));
  }
};

double or_zero(double value) {
  return std::isnan(value) ? 0.0 : value;
}

}  // namespace

TEST_CASE_TEMPLATE("Species fields: densities, momenta and temperatures add up in every cell",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Watched<D> run(61, {Estimator::Exact, {}});
  for (const double end : {0.4, 3.0, 40.0}) {
    run.simulation.run_until(end);
    const CellSums sums = run.cells.close_window();
    for (std::size_t cell = 0; cell < run.cells.grid().size(); ++cell) {
      const auto value = [&](Field field) { return or_zero(run.value(sums, cell, field)); };
      const double density = value(Quantity::Density);
      double number = 0.0, thermal = 0.0;
      Vec<D> along = Vec<D>::Zero(), diffusion = Vec<D>::Zero();
      for (std::size_t s = 0; s < kSpecies; ++s) {
        const double of_species = value(Field(Quantity::Density).of(s));
        const double mass = s == 0 ? 2.0 : s == 1 ? 0.5 : 3.0;
        number += of_species;
        thermal += of_species * value(Field(Quantity::Temperature).of(s));
        for (int k = 0; k < D; ++k) {
          along[k] += of_species * value(Field(Quantity::Temperature, k).of(s));
          diffusion[k] +=
              mass * of_species *
              (value(Field(Quantity::Velocity, k).of(s)) - value(Field(Quantity::Velocity, k)));
        }
      }
      const double T = value(Quantity::Temperature);
      CHECK(number == doctest::Approx(density).epsilon(1e-12));
      CHECK(thermal == doctest::Approx(density * T).epsilon(1e-11));
      for (int k = 0; k < D; ++k) {
        CHECK(along[k] ==
              doctest::Approx(density * value(Field(Quantity::Temperature, k))).epsilon(1e-11));
        CHECK(std::fabs(diffusion[k]) < 1e-11 * (1.0 + density * std::sqrt(T)));
      }
    }
  }
}

TEST_CASE_TEMPLATE("Species fields: a snapshot has the densities and temperatures of the state",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Watched<D> run(62, {Estimator::Snapshot, {}});
  run.simulation.run_until(7.0);
  run.cells.sample();
  const State<D> state = run.simulation.state();
  const CellSums sums = run.cells.close_window();
  const FieldGrid<D>& grid = run.cells.grid();
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    double mass = 0.0;
    Vec<D> momentum = Vec<D>::Zero();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      if (grid.index_of(grid.cell_at(state.positions[i])) != cell) continue;
      mass += state.grains[i].mass;
      momentum += state.grains[i].mass * state.velocities[i];
    }
    for (std::size_t s = 0; s < kSpecies; ++s) {
      double count = 0.0, own_mass = 0.0;
      Vec<D> squares = Vec<D>::Zero(), own = Vec<D>::Zero();
      for (std::size_t i = 0; i < state.positions.size(); ++i) {
        const Grain& grain = state.grains[i];
        if (grid.index_of(grid.cell_at(state.positions[i])) != cell || grain.species != s) continue;
        count += 1.0;
        own_mass += grain.mass;
        own += grain.mass * state.velocities[i];
        squares += grain.mass * (state.velocities[i] - momentum / mass).cwiseAbs2();
      }
      CAPTURE(cell);
      CAPTURE(s);
      const auto value = [&](Field field) { return run.value(sums, cell, field.of(s)); };
      CHECK(value(Quantity::Density) == doctest::Approx(count / grid.cell_measure()));
      CHECK(std::isnan(value(Quantity::Temperature)) == (count == 0.0));
      if (count == 0.0) continue;
      for (int k = 0; k < D; ++k) {
        CHECK(value(Field(Quantity::Temperature, k)) ==
              doctest::Approx(squares[k] / count).epsilon(1e-10));
        CHECK(value(Field(Quantity::Velocity, k)) ==
              doctest::Approx(own[k] / own_mass).epsilon(1e-10));
      }
      CHECK(value(Quantity::Temperature) ==
            doctest::Approx(squares.sum() / (D * count)).epsilon(1e-10));
    }
  }
}

// The integral of n_s V_s over the box and a time is the change of the sum of the coordinates.
TEST_CASE_TEMPLATE("Species fields: the flow of a species moves its mean place", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  Watched<D> run(63, {Estimator::Exact, {}});
  const auto places = [&] {
    const State<D> state = run.simulation.state();
    std::vector<Vec<D>> sums(kSpecies, Vec<D>::Zero());
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      sums[state.grains[i].species] += state.positions[i];
    }
    return sums;
  };
  std::vector<Vec<D>> before = places();
  double time = 0.0;
  for (const double end : {0.3, 5.0, 25.0}) {
    run.simulation.run_until(end);
    const CellSums sums = run.cells.close_window();
    const std::vector<Vec<D>> after = places();
    for (std::size_t s = 0; s < kSpecies; ++s) {
      for (int k = 0; k < D; ++k) {
        if (run.simulation.model().periodic(k)) continue;
        double moved = 0.0;
        for (std::size_t cell = 0; cell < run.cells.grid().size(); ++cell) {
          moved += or_zero(run.value(sums, cell, Field(Quantity::Density).of(s))) *
                   or_zero(run.value(sums, cell, Field(Quantity::Velocity, k).of(s)));
        }
        moved *= run.cells.grid().cell_measure() * (end - time);
        CHECK(moved == doctest::Approx(after[s][k] - before[s][k]).epsilon(1e-8));
      }
    }
    before = after;
    time = end;
  }
}

// Disks of the masses 1 and 3 collide head-on, each in its own cell. The momentum exchanged is
// twice the reduced mass times the velocity of approach: 1.5.
TEST_CASE("Species fields: drag is the momentum that a species gains, where it gains it") {
  const std::vector<Grain> grains = {{.species = 0}, {.mass = 3.0, .species = 1}};
  Model<2> model = periodic_box(8.0, 4.0);
  model.species = SpeciesLaws<2>{.pairs = std::vector<PairLaw>(4), .walls = {2, model.walls}};
  Simulation<2> simulation(model, State<2>{.positions = {{2.5, 1.0}, {4.5, 1.0}},
                                           .velocities = {{1.0, 0.0}, {0.0, 0.0}},
                                           .grains = grains});
  const std::vector<Field> fields = {Field(Quantity::Drag, 0).of(0), Field(Quantity::Drag, 0).of(1),
                                     Field(Quantity::Drag, 1).of(1)};
  CellIntegrals<2> cells(simulation, {2, 1}, moment_layout<2>(fields, false, true));
  simulation.add_observer(cells);
  simulation.run_until(3.0);
  const CellSums sums = cells.close_window();
  const auto drag = [&](std::size_t cell, std::size_t field) {
    return field_value(fields[field],
                       averages_of(cells.layout(), sums, cell, 16.0, fields[field].species));
  };
  CHECK(drag(0, 0) == doctest::Approx(-1.5 / (16.0 * 3.0)));
  CHECK(drag(1, 1) == doctest::Approx(1.5 / (16.0 * 3.0)));
  for (const auto& [cell, field] : {std::pair(1, 0), {0, 1}, {0, 2}, {1, 2}}) {
    CHECK(drag(static_cast<std::size_t>(cell), static_cast<std::size_t>(field)) == 0.0);
  }
}

// Without walls, gravity and kicks only the other species change the momentum of a species.
TEST_CASE_TEMPLATE("Species fields: drag over the box changes the momentum of a species", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = rough(inelastic(periodic_box<D>(Vec<D>::Constant(9.0)), 0.8), 0.5, 0.5);
  Simulation<D> simulation(with_species(model), mixed_gas(model, 40, 66, 2.0));
  CellIntegrals<D> cells(simulation, few_cells<D>(),
                         moment_layout<D>(species_fields<D>(), true, true));
  simulation.add_observer(cells);
  const auto momenta = [&] {
    const State<D> state = simulation.state();
    std::vector<Vec<D>> sums(kSpecies, Vec<D>::Zero());
    for (std::size_t i = 0; i < state.velocities.size(); ++i) {
      sums[state.grains[i].species] += state.grains[i].mass * state.velocities[i];
    }
    return sums;
  };
  constexpr double kEnd = 60.0;
  const std::vector<Vec<D>> before = momenta();
  simulation.run_until(kEnd);
  REQUIRE(simulation.counts().pair_collisions > 100);
  const std::vector<Vec<D>> after = momenta();
  const CellSums sums = cells.close_window();
  for (std::size_t s = 0; s < kSpecies; ++s) {
    for (int k = 0; k < D; ++k) {
      double gained = 0.0;
      for (std::size_t cell = 0; cell < cells.grid().size(); ++cell) {
        const Field drag = Field(Quantity::Drag, k).of(s);
        gained +=
            kEnd * field_value(drag, averages_of(cells.layout(), sums, cell, 1.0, drag.species));
      }
      CAPTURE(s);
      CAPTURE(k);
      CHECK(std::fabs(gained) > 1e-3);
      CHECK(gained == doctest::Approx(after[s][k] - before[s][k]).epsilon(1e-11));
    }
  }
}

TEST_CASE("Species fields: a measurement has them beside the fields of the gas") {
  const auto simulation = run_of(rough_mixture(24), 64, true);
  Measure measure;
  measure.burn_in = 0.0;
  measure.cells = {5, 4};
  measure.fields = {Quantity::Density, Field(Quantity::Temperature, 0),
                    Field(Quantity::Stress, 0, 0), Field(Quantity::Drag, 0)};
  Measurement<2> measurement(*simulation, measure, 20.0);
  simulation->run_until(20.0);
  const Measured result = measurement.result();
  REQUIRE(result.profile);
  std::vector<std::string> names, maps;
  for (std::size_t f = 0; f < result.profile->fields.size(); ++f) {
    names.push_back(result.profile->name(f));
  }
  for (const FieldMap& map : result.maps->maps) maps.push_back(name_of(map));
  const std::vector<std::string> expected = {
      "density",   "temperature_x",   "stress_xx", "density_0", "temperature_x_0", "drag_x_0",
      "density_1", "temperature_x_1", "drag_x_1",  "density_2", "temperature_x_2", "drag_x_2"};
  CHECK(names == expected);
  CHECK(maps == expected);
  double share = 0.0;
  for (const Estimate& column : result.profile->at(Field(Quantity::Density).of(1))) {
    share += column.mean * 8.0 * 9.0 / 5.0;
    CHECK(column.standard_error > 0.0);
  }
  CHECK(share == doctest::Approx(8.0).epsilon(1e-10));  // particles of species 1
}

TEST_CASE_TEMPLATE("Species fields: the number of each species has a balance in every cell",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> plain = kicked(everything<D>(), 0.17, 0.1);
  Simulation<D> simulation(with_species(with_contact_time(plain, 0.01)),
                           mixed_gas(plain, 20, 65, 2.0));
  Balance<D> balance(simulation, few_cells<D>());
  simulation.add_observer(balance);
  for (const double end : {1.0, 1.01, 30.0}) {
    simulation.run_until(end);
    const BalanceWindow<D> window = balance.close_window();
    REQUIRE(window.number_residuals.size() ==
            kSpecies * static_cast<std::size_t>(few_cells<D>().prod()));
    for (const double residual : window.number_residuals) CHECK(residual == 0.0);
  }
}

TEST_CASE(
    "Species fields: of the balances of numbers the largest residual of each species counts") {
  Residuals residuals;
  residuals.include_numbers({0.0, -0.5, 0.25, 0.0, 0.125, 1.0}, 3);
  residuals.include_numbers({0.0, 0.25, 0.0, 0.0, 0.0, 0.0}, 3);
  CHECK(residuals.numbers == std::vector{0.0, 0.5, 1.0});
  residuals.equations = {{0.0}, {0.0}, {0.0}, {0.0}};
  CHECK_THROWS_AS(require_closed(residuals), RunError);
}

}  // namespace clatter::species_fields
