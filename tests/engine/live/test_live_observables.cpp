// Observables of a watched run, as in the window.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/dimension.h"
#include "engine/live/watched_run.h"
#include "engine/measure/measurement.h"
#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kLiveEnd = 40.0;

// Windows of averages have the length 0.5. The gas has walls, so that the mean velocity is not 0.
Scene observed_gas(int dimension) {
  Scene scene = gas(VecX::Constant(dimension, dimension == 2 ? 9.0 : 5.0), 30, 0.9);
  wall_in(scene, 0, {.kind = WallKind::Thermal, .temperature = 1.0});
  scene.view.window = 4.0;
  scene.measure.burn_in = 0.0;
  scene.measure.observables = {ObservableKind::Collisions, ObservableKind::Probe,
                               ObservableKind::MeanSquaredDisplacement,
                               ObservableKind::PlaneCurrent, ObservableKind::CollisionCounts};
  scene.measure.mean_squared_displacement = {.interval = 0.3, .longest = 6.0, .lags = 4};
  return scene;
}

std::shared_ptr<const std::vector<ResultTable>> tables_of(WatchedRun& run) {
  Frame frame;
  run.fill(frame, true);
  return frame.observables;
}

void move_to(WatchedRun& run, double time) {
  REQUIRE(run.run_until(time, kNoLimit, kNoLimit));
}

template <class Same>
void check_tables(const std::vector<ResultTable>& found, const std::vector<ResultTable>& expected,
                  const Same& same) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    CAPTURE(found[k].name);
    CHECK(found[k].name == expected[k].name);
    REQUIRE(found[k].columns.size() == expected[k].columns.size());
    for (std::size_t column = 0; column < found[k].columns.size(); ++column) {
      CHECK(found[k].columns[column].name == expected[k].columns[column].name);
      CHECK(std::ranges::equal(found[k].columns[column].values, expected[k].columns[column].values,
                               same));
    }
  }
}

}  // namespace

TEST_CASE("Live observables: they have the tables of a measurement of the same time") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Scene scene = observed_gas(dimension);
    const auto run = watched_run(scene, 7);
    run->show_profile(Profiled::Fields, Axis::X);
    move_to(*run, kLiveEnd);
    const auto tables = tables_of(*run);
    REQUIRE(tables != nullptr);
    const auto measured = with_dimension(dimension, [&](auto d) {
      const auto simulation = simulation_of<d()>(scene, 7);
      Measurement<d()> measurement(*simulation, scene.measure, kLiveEnd);
      simulation->run_until(kLiveEnd);
      return measurement.result();
    });
    check_tables(*tables, measured.tables(), [](double a, double b) {
      return (std::isnan(a) && std::isnan(b)) || a == doctest::Approx(b).epsilon(1e-9);
    });
  }
}

TEST_CASE("Live observables: another profile or view leaves them as they are") {
  const Scene scene = observed_gas(2);
  const auto plain = watched_run(scene, 7), disturbed = watched_run(scene, 7);
  plain->show_profile(Profiled::Fields, Axis::X);
  move_to(*plain, kLiveEnd);
  move_to(*disturbed, 7.3);
  disturbed->show_profile(Profiled::Balances, Axis::Y);
  move_to(*disturbed, 14.1);
  View view = scene.view;
  view.trails = 1.0;
  view.window = 9.0;
  disturbed->show(view);
  move_to(*disturbed, 20.0);
  disturbed->show_profile(Profiled::Fields, Axis::X);
  move_to(*disturbed, kLiveEnd);
  check_tables(*tables_of(*disturbed), *tables_of(*plain),
               [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

TEST_CASE("Live observables: they start again when laws change") {
  const auto run = watched_run(observed_gas(2), 7);
  run->show_profile(Profiled::Fields, Axis::X);
  move_to(*run, 10.0);
  run->settle();
  run->change({{"particles.restitution", "0.5"}}, 0.0);
  move_to(*run, kLiveEnd + 0.4);
  for (const ResultTable& table : *tables_of(*run)) {
    if (table.name != "probe.series") continue;
    CHECK(column_of(table, "time").values.front() == doctest::Approx(11.0));
    CHECK(column_of(table, "time").values.size() == 30);
  }
}

TEST_CASE("Live observables: frames have none unless scene and plots ask for them") {
  const auto closed = watched_run(observed_gas(2), 7);
  move_to(*closed, 5.0);
  CHECK(tables_of(*closed) == nullptr);
  closed->show_profile(Profiled::Fields, Axis::X);
  CHECK(tables_of(*closed) != nullptr);
  Scene scene = observed_gas(2);
  scene.measure.observables.clear();
  const auto without = watched_run(scene, 7);
  without->show_profile(Profiled::Fields, Axis::X);
  move_to(*without, 5.0);
  CHECK(tables_of(*without) == nullptr);
}
