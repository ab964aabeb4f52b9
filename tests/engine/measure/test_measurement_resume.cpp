// A measurement that is resumed with its run gives the same numbers as the uninterrupted one, bit
// for bit.

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kBurnIn = 3.3;
constexpr double kEnd = 43.7;

Measure measure_of(std::vector<Field> fields) {
  Measure measure;
  measure.burn_in = kBurnIn;
  measure.series_interval = 0.7;
  measure.fields = std::move(fields);
  measure.cells = {5, 4};
  return measure;
}

/// All observables.
Measure with_observables(Measure measure) {
  measure.observables = {ObservableKind::RadialDistribution,
                         ObservableKind::VelocityDistribution,
                         ObservableKind::FreeFlights,
                         ObservableKind::Collisions,
                         ObservableKind::WallHits,
                         ObservableKind::MeanSquaredDisplacement,
                         ObservableKind::VelocityAutocorrelation,
                         ObservableKind::StructureFactor,
                         ObservableKind::Clusters,
                         ObservableKind::BondOrder,
                         ObservableKind::WallPower,
                         ObservableKind::PlaneCurrent,
                         ObservableKind::LocalDensity,
                         ObservableKind::SpinDistribution,
                         ObservableKind::Probe,
                         ObservableKind::CollisionCounts,
                         ObservableKind::RadialDistributionProfile};
  measure.mean_squared_displacement = {.interval = 0.3, .longest = 9.0, .lags = 4};
  return measure;
}

/// A run and its measurement.
struct Run {
  std::unique_ptr<Simulation<2>> simulation;
  std::unique_ptr<Measurement<2>> measurement;
};

Run started(const Scene& scene, const Measure& measure) {
  Run run{simulation_of<2>(scene, 5), nullptr};
  run.measurement = std::make_unique<Measurement<2>>(*run.simulation, measure, kEnd);
  return run;
}

Run taken_up(const Scene& scene, const Measure& measure, const Run& before) {
  const std::string saved = before.measurement->save();
  Run run{std::make_unique<Simulation<2>>(model_of<2>(scene, 5), before.simulation->save()),
          nullptr};
  run.measurement = std::make_unique<Measurement<2>>(*run.simulation, measure, kEnd,
                                                     ArchiveReader(saved, "saved"));
  // Saving does not change the measurement: a second save is equal.
  REQUIRE(run.measurement->save() == saved);
  return run;
}

std::uint64_t bits(double number) {
  return std::bit_cast<std::uint64_t>(number);
}

bool same(const FieldMaps& a, const FieldMaps& b) {
  return a.begin == b.begin && a.end == b.end &&
         std::ranges::equal(a.maps, b.maps, [](const FieldMap& x, const FieldMap& y) {
           return x.cells == y.cells && std::ranges::equal(x.values, y.values, {}, bits, bits);
         });
}

void check_same(const Run& a, const Run& b) {
  CHECK(a.simulation->state_hash() == b.simulation->state_hash());
  CHECK((a.measurement->save() == b.measurement->save()));
  const Measured x = a.measurement->result(), y = b.measurement->result();
  CHECK(x.duration == y.duration);
  CHECK(x.burn_in == y.burn_in);
  CHECK(x.pair_collisions == y.pair_collisions);
  CHECK(x.temperature.mean == y.temperature.mean);
  CHECK(x.temperature.standard_error == y.temperature.standard_error);
  CHECK(x.ledger_residual == y.ledger_residual);
  CHECK(x.series.times == y.series.times);
  CHECK(x.series.temperature == y.series.temperature);
  REQUIRE(x.residuals.has_value() == y.residuals.has_value());
  if (x.residuals) CHECK(x.residuals->equations == y.residuals->equations);
  CHECK(x.maps.has_value() == y.maps.has_value());
  if (x.maps) CHECK(same(*x.maps, *y.maps));
  CHECK(
      std::ranges::equal(x.map_series, y.map_series, [](auto& a, auto& b) { return same(a, b); }));
  CHECK((a.measurement->save() == b.measurement->save()));
}

}  // namespace

TEST_CASE("Measurement: it resumes at any time, bit for bit") {
  for (const Scene& scene : {gas(9.0, 8.0, 20, 0.9), rough_mixture(20), everything_in_motion(20)}) {
    for (const Measure& measure :
         {measure_of({Quantity::Density}), measure_of({}), measure_of({Quantity::BalanceEnergy}),
          with_observables(measure_of({}))}) {
      const Run straight = started(scene, measure);
      straight.simulation->run_until(kEnd);
      Run halted = started(scene, measure);
      const auto resume = [&](Run& run) {
        Run next = taken_up(scene, measure, run);
        std::swap(run, next);
      };
      // Times in the burn-in, at its end, within a window, and at the end of a window.
      for (const double time : {0.0, 1.0, 2.1, kBurnIn, 3.4, 10.0, 11.2, 25.0, 43.6}) {
        halted.simulation->run_until(time);
        resume(halted);
      }
      // And between two events of the same run.
      for (int k = 0; k < 200 && halted.simulation->time() < kEnd; ++k) {
        halted.simulation->run_until(kEnd, halted.simulation->counts().collisions() + 1);
        resume(halted);
      }
      halted.simulation->run_until(kEnd);
      check_same(halted, straight);
    }
  }
}

TEST_CASE("Measurement: resumed for a longer time it keeps the length of its windows") {
  const Measure measure = measure_of({Quantity::Density, Quantity::BalanceMass});
  const Run first = started(rough_mixture(20), measure);
  first.simulation->run_until(kEnd);
  const Run longer = taken_up(rough_mixture(20), measure, first);
  const double span = kEnd - kBurnIn;
  longer.simulation->run_until(kBurnIn + 3.0 * span);
  CHECK(first.measurement->result().duration == doctest::Approx(span));
  const Measured measured = longer.measurement->result();
  CHECK(measured.duration == doctest::Approx(3.0 * span));
  CHECK(measured.series.times.back() == doctest::Approx(kBurnIn + 3.0 * span).epsilon(0.01));
  CHECK(measured.ledger_residual < 1e-12);
  CHECK(std::ranges::max(measured.residuals->largest()) < 1e-12);
}

TEST_CASE("Measurement: one that starts in the midst of a run averages from then on") {
  const auto simulation = simulation_of<2>(rough_mixture(20), 5);
  simulation->run_until(10.0);
  Measurement measurement(*simulation, measure_of({Quantity::Density}), kEnd);
  simulation->run_until(kEnd);
  const Measured measured = measurement.result();
  CHECK(measured.burn_in == 10.0);
  CHECK(measured.duration == doctest::Approx(kEnd - 10.0));
  CHECK(measured.series.times.front() == doctest::Approx(10.5));
  double particles = 0.0;
  for (const Estimate& density : measured.profile->at(Quantity::Density))
    particles += density.mean * 9.0 / 5.0 * 8.0;
  CHECK(particles == doctest::Approx(20.0));
}

TEST_CASE("Measurement: spins that smooth laws keep leave no gap in the ledger") {
  const Measure measure = measure_of({});
  const Run rough = started(everything_in_motion(20), measure);
  rough.simulation->run_until(10.0);
  REQUIRE(rough.simulation->spin_energy() > 0.1);
  Scene scene = everything_in_motion(20);
  scene.particles.roughness = {};
  Run smooth{std::make_unique<Simulation<2>>(model_of<2>(scene, 5), rough.simulation->save()),
             nullptr};
  const std::string saved = rough.measurement->save();
  smooth.measurement = std::make_unique<Measurement<2>>(*smooth.simulation, measure, kEnd,
                                                        ArchiveReader(saved, "saved"));
  CHECK(smooth.simulation->spin_energy() == rough.simulation->spin_energy());
  smooth.simulation->run_until(kEnd);
  CHECK(smooth.measurement->result().ledger_residual < 1e-12);
}

TEST_CASE("Measurement: bytes of no measurement are refused") {
  const Measure measure = measure_of({Quantity::Density});
  const Run run = started(rough_mixture(20), measure);
  run.simulation->run_until(10.0);
  const std::string saved = run.measurement->save();
  const Simulation<2>& simulation = *run.simulation;
  // A run would need hours for all windows of 1e-9 since the burn-in.
  const auto with_window = [&](double window) {
    const double before = run.measurement->window();
    const std::string old(reinterpret_cast<const char*>(&before), sizeof before);
    std::string bytes = saved;
    return bytes.replace(bytes.find(old), old.size(),
                         std::string(reinterpret_cast<const char*>(&window), sizeof window));
  };
  REQUIRE(with_window(run.measurement->window()) == saved);
  for (const std::string& bytes :
       {std::string(), saved + '\0', saved.substr(0, saved.size() - 1), saved.substr(8),
        with_window(1e-9), with_window(0.0), with_window(-1.0), with_window(std::nan(""))}) {
    Simulation<2> other(simulation.model(), simulation.save());
    CHECK_THROWS_AS(Measurement<2>(other, measure, kEnd, ArchiveReader(bytes, "saved")), UserError);
  }
}
