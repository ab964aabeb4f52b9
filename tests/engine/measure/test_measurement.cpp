#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/measure/measurement.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/measure/sums.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A measurement of the whole box for `duration` after `burn_in`.
Measure measure_for(double burn_in, double duration) {
  Measure measure;
  measure.burn_in = burn_in;
  measure.duration = duration;
  return measure;
}

Measured measured(Simulation<2>& simulation, const Measure& measure) {
  const double end = measure.burn_in + measure.duration;
  Measurement measurement(simulation, measure, end);
  simulation.run_until(end);
  return measurement.result();
}

bool finite(const Estimate& estimate) {
  return std::isfinite(estimate.mean) && std::isfinite(estimate.standard_error);
}

/// Whether all present numbers are finite.
bool finite(const Measured& result) {
  bool all = std::isfinite(result.duration) && std::isfinite(result.ledger_residual);
  for (const Estimate& e : {result.temperature, result.axis_temperatures[0],
                            result.axis_temperatures[1], result.kurtosis_excess[0],
                            result.kurtosis_excess[1], result.collision_rate, result.dissipated}) {
    all = all && finite(e);
  }
  for (const auto& e : {result.walls_in, result.compressibility, result.pressure[0],
                        result.pressure[1], result.pressure[2], result.pressure[3]}) {
    all = all && (!e || finite(*e));
  }
  for (const double t : result.series.temperature) all = all && std::isfinite(t);
  if (result.profile) {
    // Columns without particles have a density, but no temperature.
    const std::vector<Estimate>& density = result.profile->at(Quantity::Density);
    for (std::size_t k = 0; k < density.size(); ++k) {
      for (const Field field : result.profile->fields) {
        const bool known = field == Quantity::Density || density[k].mean > 0.0;
        all = all && finite(result.profile->at(field)[k]) == known;
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("Measurement: averages over the time after the burn-in, all of it and nothing else") {
  const Scene scene = rough_mixture(20);
  const auto simulation = simulation_of<2>(scene, 41);
  const Measured result = measured(*simulation, measure_for(7.3, 31.9));
  CHECK(result.duration == doctest::Approx(31.9).epsilon(1e-12));
  CHECK(result.ledger_residual < 1e-13);

  // The same with one window of a separate Totals.
  const auto again = simulation_of<2>(scene, 41);
  again->run_until(7.3);
  const EventCounts at_start = again->counts();
  Totals<2> totals(*again);
  again->add_observer(totals);
  again->run_until(7.3 + 31.9);
  const WindowTotals<2> window = totals.close_window();
  CHECK(again->state_hash() == simulation->state_hash());
  CHECK(result.pair_collisions == again->counts().pair_collisions - at_start.pair_collisions);
  CHECK(result.wall_collisions == again->counts().wall_collisions - at_start.wall_collisions);
  CHECK(result.axis_temperatures[0].mean == doctest::Approx(window.temperature.x()).epsilon(1e-9));
  CHECK(result.axis_temperatures[1].mean == doctest::Approx(window.temperature.y()).epsilon(1e-9));
  CHECK(result.temperature.mean == doctest::Approx(0.5 * window.temperature.sum()).epsilon(1e-9));
  CHECK(result.dissipated.mean == doctest::Approx(window.dissipated / 31.9).epsilon(1e-9));
  CHECK(result.collision_rate.mean ==
        doctest::Approx(2.0 * window.collisions / (20.0 * 31.9)).epsilon(1e-9));
  REQUIRE(result.walls_in);
  CHECK(result.walls_in->mean == doctest::Approx(window.walls_in / 31.9).epsilon(1e-9));
  for (int side = 0; side < 4; ++side) {
    const double length = side < 2 ? 8.0 : 9.0;
    REQUIRE(result.pressure[side]);
    CHECK(result.pressure[side]->mean ==
          doctest::Approx(window.wall_impulse[side] / (31.9 * length)).epsilon(1e-9));
  }
  CHECK_FALSE(result.compressibility);
}

TEST_CASE("Measurement: the last window counts, also where rounding puts its end after the run's") {
  for (int k = 1; k <= 200; ++k) {
    const auto simulation = simulation_of<2>(gas(10.0, 10.0, 1, 1.0), 42);
    Measure measure = measure_for(0.1 * k, 0.7 * k);
    measure.series_interval = measure.duration / 700.0;  // not a power of two
    CAPTURE(k);
    CHECK(measured(*simulation, measure).duration == doctest::Approx(0.7 * k).epsilon(1e-12));
  }
}

TEST_CASE("Measurement: the series starts at 0 and holds the burn-in") {
  const auto simulation = simulation_of<2>(gas(10.0, 10.0, 10, 0.8), 43);
  Measure measure = measure_for(2.0, 4.0);
  measure.series_interval = 0.75;
  const Measured result = measured(*simulation, measure);
  REQUIRE(result.series.times.size() == 9);  // 0 to 6
  REQUIRE(result.series.temperature.size() == 9);
  const auto again = simulation_of<2>(gas(10.0, 10.0, 10, 0.8), 43);
  for (std::size_t k = 0; k < 9; ++k) {
    CHECK(result.series.times[k] == 0.75 * static_cast<double>(k));
    again->run_until(result.series.times[k]);
    CHECK(result.series.temperature[k] == again->kinetic_energy() / 10.0);
  }
  CHECK(result.series.temperature.front() == doctest::Approx(1.0).epsilon(1e-14));
}

TEST_CASE("Measurement: an interrupted run has its results so far") {
  Measure measure = measure_for(10.0, 100.0);
  measure.fields = {Quantity::Density};
  const Scene scene = rough_mixture(15);
  const auto simulation = simulation_of<2>(scene, 44);
  Measurement measurement(*simulation, measure, 110.0);
  CHECK(finite(measurement.result()));  // no event yet

  simulation->run_until(5.0);
  const Measured burning = measurement.result();
  CHECK(finite(burning));
  CHECK(burning.duration == 0.0);
  CHECK(burning.series.times.size() == 6);
  CHECK_FALSE(burning.profile);

  simulation->run_until(60.0, simulation->counts().collisions() + 150);  // halts at a collision
  const double time = simulation->time();
  REQUIRE(time > 10.2);
  REQUIRE(time < 60.0);
  const Measured halted = measurement.result();
  CHECK(finite(halted));
  CHECK(halted.duration <= time - 10.0);
  CHECK(halted.duration > time - 10.0 - 100.0 / 512.0);
  CHECK(halted.profile);

  simulation->run_until(110.0);  // continuing is unaffected by the intermediate result
  const auto again = simulation_of<2>(scene, 44);
  const Measured whole = measured(*again, measure);
  const Measured resumed = measurement.result();
  CHECK(resumed.duration == doctest::Approx(100.0).epsilon(1e-12));
  CHECK(resumed.temperature.mean == whole.temperature.mean);
  CHECK(resumed.temperature.standard_error == whole.temperature.standard_error);
  CHECK(measurement.result().temperature.mean == whole.temperature.mean);  // read again
}

TEST_CASE("Measurement: profiles across x, averaged over y") {
  Measure measure = measure_for(3.0, 40.0);
  measure.fields = {Quantity::Density, Field(Quantity::Temperature, 0),
                    Field(Quantity::Temperature, 1)};
  measure.cells = {6, 4};
  const Scene scene = rough_mixture(20);
  const auto simulation = simulation_of<2>(scene, 45);
  const Measured result = measured(*simulation, measure);
  REQUIRE(result.profile);
  REQUIRE(result.profile->edges.size() == 7);
  CHECK(result.profile->edges.front() == 0.0);
  CHECK(result.profile->edges[3] == 4.5);
  CHECK(result.profile->edges.back() == 9.0);
  REQUIRE(result.profile->at(Quantity::Density).size() == 6);

  // The same with one window of six columns.
  const auto again = simulation_of<2>(scene, 45);
  again->run_until(3.0);
  CellIntegrals<2> columns(*again, {6, 1}, full_layout());
  again->add_observer(columns);
  again->run_until(43.0);
  const auto integrals = close(columns);
  double mean_density = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    CAPTURE(i);
    const Sums& column = integrals[i];
    const Vec2 mean = column.velocity / column.count;
    const Vec2 temperature = column.squares() / column.count - mean.cwiseAbs2();
    CHECK(result.profile->at(Quantity::Density)[i].mean ==
          doctest::Approx(column.count / (40.0 * 9.0 * 8.0 / 6.0)).epsilon(1e-9));
    CHECK(result.profile->at(Field(Quantity::Temperature, 0))[i].mean ==
          doctest::Approx(temperature.x()).epsilon(1e-9));
    CHECK(result.profile->at(Field(Quantity::Temperature, 1))[i].mean ==
          doctest::Approx(temperature.y()).epsilon(1e-9));
    CHECK(result.profile->at(Quantity::Density)[i].standard_error > 0.0);
    CHECK(result.profile->at(Field(Quantity::Temperature, 0))[i].standard_error > 0.0);
    mean_density += result.profile->at(Quantity::Density)[i].mean / 6.0;
  }
  CHECK(mean_density == doctest::Approx(20.0 / 72.0).epsilon(1e-10));
}

TEST_CASE("Measurement: snapshots at the interval, collisions all the time") {
  Measure measure = measure_for(3.0, 40.0);
  measure.fields = {Quantity::Density, Field(Quantity::Temperature, 1),
                    Field(Quantity::Stress, 0, 1), Field(Quantity::HeatFlux, 1),
                    Quantity::Dissipation};
  measure.cells = {4, 6};
  measure.profile_axis = Axis::Y;
  const Scene scene = rough_mixture(20);
  const auto simulation = simulation_of<2>(scene, 50);
  const Measured exact = measured(*simulation, measure);
  for (const double interval : {0.7, 0.0125}) {
    CAPTURE(interval);
    measure.estimator = Estimator::Snapshot;
    measure.interval = interval;
    const auto again = simulation_of<2>(scene, 50);
    const Measured snapshots = measured(*again, measure);
    CHECK(again->state_hash() == simulation->state_hash());

    const auto sampled = simulation_of<2>(scene, 50);
    std::vector<double> density(6);
    const int samples = static_cast<int>(std::round(40.0 / interval - 0.5));
    for (int k = 1; k <= samples; ++k) {
      sampled->run_until(3.0 + k * interval);
      for (const Vec2& r : sampled->state().positions) {
        density[static_cast<std::size_t>(r.y() * 6.0 / 8.0)] += 1.0 / (samples * 9.0 * 8.0 / 6.0);
      }
    }
    for (std::size_t i = 0; i < 6; ++i) {
      CAPTURE(i);
      const auto of = [&](const Measured& result, Field field) {
        return result.profile->at(field)[i];
      };
      // The last sample may be a rounding error after the end.
      CHECK(of(snapshots, Quantity::Density).mean ==
            doctest::Approx(density[i]).epsilon(interval > 0.1 ? 1e-12 : 1e-2));
      CHECK(of(snapshots, Quantity::Dissipation).mean ==
            doctest::Approx(of(exact, Quantity::Dissipation).mean).epsilon(1e-12));
      CHECK(of(snapshots, Quantity::Dissipation).standard_error ==
            doctest::Approx(of(exact, Quantity::Dissipation).standard_error).epsilon(1e-9));
      if (interval > 0.1) continue;
      for (const Field field : measure.fields) {
        CAPTURE(name_of(field));
        const Estimate a = of(exact, field), b = of(snapshots, field);
        CHECK(std::fabs(a.mean - b.mean) < 0.25 * a.standard_error);
        CHECK(b.standard_error == doctest::Approx(a.standard_error).epsilon(0.05));
      }
    }
  }
}

TEST_CASE("Measurement: a density that cannot vary has no error, however snapshots fall") {
  Measure measure = measure_for(1.0, 50.0);
  measure.fields = {Quantity::Density};
  measure.cells = {1, 1};
  measure.estimator = Estimator::Snapshot;
  for (const double interval : {0.03, 0.17, 0.9}) {  // windows are 50/512
    CAPTURE(interval);
    measure.interval = interval;
    const auto simulation = simulation_of<2>(gas(5.0, 4.0, 8, 1.0), 52);
    const Estimate density = measured(*simulation, measure).profile->at(Quantity::Density)[0];
    CHECK(density.mean == doctest::Approx(0.4));
    CHECK(density.standard_error < 1e-12);
  }
}

TEST_CASE("Measurement: errors are the scatter of runs") {
  // The scatter of 40 runs has an uncertainty of 11 %, the mean of their errors less. A current of
  // a conserved quantity fluctuates back and forth, so that its blocking error is an upper limit
  // only.
  Scene scene = gas(10.0, 10.0, 12, 0.9);
  wall_in(scene, 0, {.kind = WallKind::Driven, .drive_speed = 1.0});
  Measure measure = measure_for(40.0, 4000.0);
  measure.fields = {Quantity::Density,
                    Field(Quantity::Temperature, 0),
                    Field(Quantity::Stress, 0, 0),
                    Field(Quantity::HeatFlux, 0),
                    Field(Quantity::Stress, 0, 1),
                    Quantity::Dissipation};
  measure.cells = {3, 2};
  constexpr int kRuns = 40;
  std::vector<double> sum(measure.fields.size()), squares(sum.size()), errors(sum.size());
  for (int run = 0; run < kRuns; ++run) {
    const auto simulation = simulation_of<2>(scene, 500 + static_cast<std::uint64_t>(run));
    const Measured result = measured(*simulation, measure);
    for (std::size_t f = 0; f < sum.size(); ++f) {
      const Estimate& middle = result.profile->at(measure.fields[f])[1];
      sum[f] += middle.mean / kRuns;
      squares[f] += middle.mean * middle.mean / kRuns;
      errors[f] += middle.standard_error / kRuns;
    }
  }
  for (std::size_t f = 0; f < sum.size(); ++f) {
    CAPTURE(f);
    const double scatter = std::sqrt(squares[f] - sum[f] * sum[f]);
    const Field field = measure.fields[f];
    const bool conserved =
        field == Field(Quantity::HeatFlux, 0) || field == Field(Quantity::Stress, 0, 1);
    CHECK(errors[f] / scatter > 0.65);
    if (!conserved) CHECK(errors[f] / scatter < 1.5);
  }
}

TEST_CASE("Measurement: a flow changes neither the profile of T nor its error") {
  // Profiles along x do not depend on a flow along y. The gas is so dilute that rounding
  // differences between the two runs cannot grow in its few collisions.
  Measure measure = measure_for(0.0, 50.0);
  measure.fields = {Field(Quantity::Temperature, 1)};
  measure.cells = {3, 1};
  const Scene scene = gas(30.0, 30.0, 12, 1.0);
  State<2> start = start_state<2>(scene, 49);
  Simulation<2> at_rest(model_of<2>(scene, 49), start);
  for (Vec2& v : start.velocities) v.y() += 3.0;
  Simulation<2> flowing(model_of<2>(scene, 49), start);
  const Measured expected = measured(at_rest, measure);
  const Measured result = measured(flowing, measure);
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    const Estimate& still = expected.profile->at(Field(Quantity::Temperature, 1))[i];
    const Estimate& moved = result.profile->at(Field(Quantity::Temperature, 1))[i];
    CHECK(moved.mean == doctest::Approx(still.mean).epsilon(1e-6));
    CHECK(moved.standard_error == doctest::Approx(still.standard_error).epsilon(1e-6));
    CHECK(moved.standard_error < 0.5 * moved.mean);
  }
}

TEST_CASE("Measurement: the pressure of one particle between two walls") {
  // 10 from wall to wall at speed 2: each wall receives 2 * 2 every 10 time units, on a length of
  // 8.
  Scene scene = gas(11.0, 8.0, 1, 1.0);
  wall_in(scene, 0, Wall{});
  const auto simulation = lone_particle(scene, {5.5, 4.0}, {2.0, 0.0});
  const Measured result = measured(*simulation, measure_for(0.0, 1000.0));
  CHECK(result.wall_collisions == 200);
  for (const int side : {kLeft, kRight}) {
    REQUIRE(result.pressure[side]);
    CHECK(result.pressure[side]->mean == doctest::Approx(4.0 / (10.0 * 8.0)).epsilon(1e-12));
  }
  CHECK_FALSE(result.pressure[kBottom]);
  CHECK(result.walls_in->mean == 0.0);
}

TEST_CASE("Measurement: a gas of none, and of one") {
  for (const bool walled : {false, true}) {
    for (const int count : {0, 1}) {
      CAPTURE(walled);
      CAPTURE(count);
      Scene scene = gas(8.0, 8.0, count, 0.9);
      if (walled) wall_in(scene, 0, {.kind = WallKind::Driven, .drive_speed = 0.01});
      Measure measure = measure_for(2.0, 20.0);
      measure.fields = {Quantity::Density, Field(Quantity::Temperature, 0),
                        Field(Quantity::Temperature, 1)};
      const auto simulation = simulation_of<2>(scene, 47);
      const Measured result = measured(*simulation, measure);
      CHECK(finite(result));
      CHECK(result.pair_collisions == 0);
      CHECK(result.series.temperature.size() == 23);
      CHECK(result.collision_rate.mean == 0.0);
      CHECK_FALSE(result.compressibility);
      if (count == 1 && !walled) CHECK(result.temperature.mean == doctest::Approx(1.0));
    }
  }
}

// A density needs one number per cell or column. A balance has D + 2 numbers: mass, momenta,
// energy. Per cell and window it has the sum and the magnitude of all bookings at D faces and
// inside, and the content; of all windows, four more.
TEST_CASE("Measurement: the memory of profiles is a row per window, that of balances two windows") {
  Measure measure = measure_for(0.0, 512.0);
  measure.series_interval = 1.0;
  measure.cells = {7, 5, 3};
  measure.fields = {Quantity::BalanceEnergy};
  CHECK(cells_memory<2>(measure, false) == 7 * 5 * 4 * 8 * (2 * (3 * 2 + 1) + 4));
  CHECK(cells_memory<3>(measure, false) == 7 * 5 * 3 * 5 * 8 * (2 * (4 * 2 + 1) + 4));
  measure.cells = {7, 5};
  measure.fields = {Quantity::Density};
  const double least = cells_memory<2>(measure, false);
  measure.duration = 8192.0;
  CHECK(cells_memory<2>(measure, false) - least == (8192 - 512) * 7 * 8);
}

TEST_CASE("Measurement: a gas at rest, or so cold that products of its velocities are 0") {
  Measure measure = measure_for(1.0, 7.0);
  measure.fields = {Quantity::Density, Field(Quantity::Temperature, 0)};
  for (const double temperature : {0.0, 1e-80, 1e-120, 1e-160, 1e-300}) {
    CAPTURE(temperature);
    Scene scene = gas(10.0, 10.0, 5, 0.9);
    scene.particles.start.temperature = temperature;
    const auto simulation = simulation_of<2>(scene, 44);
    const Measured result = measured(*simulation, measure);
    CHECK(finite(result));
    CHECK(result.kurtosis_excess[0].mean >= -1.0);
    if (temperature == 0.0) CHECK(result.temperature.mean == 0.0);
  }
}

TEST_CASE("Measurement: a request stops the results at any field, and changes nothing") {
  const auto simulation = simulation_of<2>(rough_mixture(20), 53);
  Measure measure = measure_for(2.0, 8.0);
  measure.fields = {Quantity::Density, Quantity::Temperature};
  Measurement<2> measurement(*simulation, measure, 10.0);
  simulation->run_until(10.0);
  for (const int yes : {1, 2, 3}) {
    int looks = 0;
    CHECK_THROWS_AS(measurement.result([&] { return ++looks == yes; }), Interrupted);
  }
  const auto again = simulation_of<2>(rough_mixture(20), 53);
  Measurement<2> other(*again, measure, 10.0);
  again->run_until(10.0);
  const Measured stopped = measurement.result(), straight = other.result();
  CHECK(stopped.duration == straight.duration);
  CHECK(stopped.temperature.mean == straight.temperature.mean);
  REQUIRE(stopped.maps);
  CHECK(stopped.maps->maps[0].values == straight.maps->maps[0].values);
}
