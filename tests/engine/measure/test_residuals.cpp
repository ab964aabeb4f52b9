#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/measure/residuals.h"
#include "engine/scene/field.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Measure residual_settings(std::vector<Field> fields) {
  Measure measure;
  measure.burn_in = 3.3;
  measure.duration = 52.0;
  measure.series_interval = 0.1;  // 520 windows
  measure.fields = std::move(fields);
  measure.cells = {5, 4};
  return measure;
}

Measured measured(const Scene& scene, const Measure& measure) {
  const auto simulation = simulation_of<2>(scene, 61);
  const double end = measure.burn_in + measure.duration;
  Measurement measurement(*simulation, measure, end);
  simulation->run_until(end);
  return measurement.result();
}

const std::vector<Field> kBalance = residual_fields(2);

}  // namespace

TEST_CASE("Residuals: each equation has its largest residual of all windows, with its sign") {
  const Imbalances<2> first{{{1.0, -2.0, 0.0, 3.0}, {0.0, 0.0, 0.0, -5.0}},
                            {{2.0, 4.0, 8.0, 16.0}, {1.0, 1.0, 1.0, 10.0}}};
  const Imbalances<2> second{{{0.5, 3.0, -1.0, 1.0}, {0.0, 0.0, 4.0, 1.0}},
                             {{2.0, 4.0, 8.0, 16.0}, {1.0, 1.0, 0.0, 10.0}}};
  Residuals residuals;
  residuals.include(first);
  residuals.include(second);
  CHECK(residuals.map(Quantity::BalanceMass) == std::vector{0.5, 0.0});
  CHECK(residuals.map(Field(Quantity::BalanceMomentum, 0)) == std::vector{0.75, 0.0});
  CHECK(residuals.map(Field(Quantity::BalanceMomentum, 1)) == std::vector{-0.125, 1.0});
  CHECK(residuals.map(Quantity::BalanceEnergy) == std::vector{0.1875, -0.5});
  CHECK(residuals.largest() == std::vector{0.5, 0.75, 1.0, 0.5});
}

TEST_CASE("Imbalances: two time spans add up") {
  Imbalances<2> sum;
  sum += {{{1.0, -2.0, 0.0, 3.0}}, {{2.0, 4.0, 8.0, 16.0}}};
  sum += {{{1.0, 3.0, 0.0, -3.0}}, {{2.0, 4.0, 8.0, 16.0}}};
  CHECK(sum.residual(0) == Conserved<2>(0.5, 0.125, 0.0, 0.0));
}

TEST_CASE("Residuals: NaN is larger than any number") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Residuals residuals;
  residuals.include<2>({{{0.0, nan, 0.0, 0.0}}, {{1.0, 1.0, 1.0, 1.0}}});
  residuals.include<2>({{{1.0, 1.0, 0.0, 0.0}}, {{1.0, 1.0, 1.0, 1.0}}});
  CHECK(std::isinf(residuals.largest()[1]));
  CHECK(residuals.largest()[0] == 1.0);
}

TEST_CASE("Residuals: those beyond rounding are an error, which says how large they are") {
  Residuals residuals{{{0.0}, {1e-15}, {-9e-7}, {0.0}}};
  CHECK_NOTHROW(require_closed(residuals));
  residuals.equations = {{0.0}, {0.0}, {0.0}, {-2.5e-6}};
  CHECK_THROWS_WITH_AS(require_closed(residuals),
                       "the balance equations do not close: residuals are as large as 2.5e-06; "
                       "please report this scene and seed",
                       RunError);
  residuals.equations[0][0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(require_closed(residuals), RunError);
}

TEST_CASE("Measurement: balances close where residuals are asked for, and only there") {
  const Measured balanced = measured(everything_in_motion(20), residual_settings(kBalance));
  REQUIRE(balanced.residuals);
  CHECK(balanced.residuals->equations[0].size() == 20);
  CHECK(balanced.residuals->largest()[0] == 0.0);
  CHECK(std::ranges::min(balanced.residuals->largest()) == 0.0);
  CHECK(std::ranges::max(balanced.residuals->largest()) > 0.0);
  CHECK(std::ranges::max(balanced.residuals->largest()) < 1e-12);
  CHECK_FALSE(balanced.profile);

  const Measured averaged =
      measured(everything_in_motion(20), residual_settings({Quantity::Density}));
  CHECK_FALSE(averaged.residuals);
  CHECK(averaged.profile);

  std::vector<Field> fields = kBalance;
  fields.push_back(Quantity::Density);
  const Measured both = measured(everything_in_motion(20), residual_settings(fields));
  CHECK(both.residuals->equations == balanced.residuals->equations);
  CHECK(both.profile->fields == std::vector{Field(Quantity::Density)});
  CHECK(both.temperature.mean == averaged.temperature.mean);
  CHECK_FALSE(measured(gas(9.0, 8.0, 0, 1.0), residual_settings(kBalance)).residuals);
}

TEST_CASE("Measurement: residuals have maps over the whole time, after the maps of averages") {
  std::vector<Field> fields = kBalance;
  fields.push_back(Quantity::Density);
  const Measured both = measured(everything_in_motion(20), residual_settings(fields));
  REQUIRE(both.maps->maps.size() == 5);
  CHECK(both.maps->maps[0].field == Quantity::Density);
  CHECK(both.maps->maps[4].field == Quantity::BalanceEnergy);
  CHECK(both.map_series[0].maps.size() == 1);

  const Measured alone = measured(everything_in_motion(20), residual_settings(kBalance));
  CHECK(alone.map_series.empty());
  CHECK(alone.maps->begin == both.maps->begin);
  CHECK(alone.maps->end == both.maps->end);
  CHECK(alone.maps->cell == both.maps->cell);
  for (std::size_t k = 0; k < kBalance.size(); ++k) {
    const FieldMap& map = alone.maps->maps.at(k);
    CHECK(map.field == kBalance[k]);
    CHECK(map.cells == std::vector{5, 4});
    CHECK(map.values == alone.residuals->map(kBalance[k]));
  }
}

// 32 averaging windows form one window of the balance. Of 520, 8 remain for the last one.
TEST_CASE("Measurement: residuals are of all the time after the burn-in") {
  const Measure measure = residual_settings(kBalance);
  const auto simulation = simulation_of<2>(everything_in_motion(20), 61);
  const double end = measure.burn_in + measure.duration;
  const double window = (end - measure.burn_in) / 520.0;
  std::optional<Balance<2>> balance;
  Residuals residuals;
  int windows = -1;
  simulation->every(measure.burn_in, window, [&](double) {
    if (++windows == 0) {
      balance.emplace(*simulation, IntVec<2>(5, 4));
      simulation->add_observer(*balance);
    } else if (windows % 32 == 0) {
      residuals.include(balance->close_window().imbalances);
    }
  });
  simulation->run_until(end);
  residuals.include(balance->close_window().imbalances);
  REQUIRE(windows / 32 == 16);
  CHECK(measured(everything_in_motion(20), measure).residuals->equations == residuals.equations);
}

TEST_CASE("Measurement: snapshots leave the balance as it is") {
  Measure measure = residual_settings(kBalance);
  const auto exact = measured(everything_in_motion(20), measure).residuals->equations;
  measure.estimator = Estimator::Snapshot;
  measure.interval = 0.7;
  CHECK(measured(everything_in_motion(20), measure).residuals->equations == exact);
}
