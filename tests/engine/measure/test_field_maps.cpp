#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "engine/measure/field_maps.h"
#include "engine/measure/measurement.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A window with its own number, so that sums identify their windows.
CellSums numbered(int window, std::size_t numbers = 1) {
  CellSums sums{1.0, 1.0, std::vector<double>(numbers)};
  sums.rows[0] = window;
  return sums;
}

/// The maps of these fields after 50 time units of a gas between walls, on 6 x 4 cells.
Measured measured(const std::vector<Field>& fields, Axis axis = Axis::X) {
  const auto simulation = simulation_of<2>(rough_mixture(20), 5);
  Measure measure;
  measure.burn_in = 3.3;
  measure.fields = fields;
  measure.cells = {6, 4};
  measure.profile_axis = axis;
  Measurement measurement(*simulation, measure, 53.3);
  simulation->run_until(53.3);
  return measurement.result();
}

/// The mean of a map over the cells of a column.
double column_mean(const FieldMap& map, Axis axis, int column) {
  double sum = 0.0;
  for (int j = 0; j < map.cells[1]; ++j) {
    for (int i = 0; i < map.cells[0]; ++i) {
      if ((axis == Axis::X ? i : j) == column) sum += map.values[i + j * map.cells[0]];
    }
  }
  return sum / map.cells[axis == Axis::X ? 1 : 0];
}

}  // namespace

TEST_CASE("PartSums: windows go into equal parts, whose number stays bounded") {
  PartSums<CellSums> sums;
  for (int window = 0; window < 1000; ++window) {
    sums.add(numbered(window));
    const auto count = static_cast<int>(sums.parts().size());
    const auto span = static_cast<int>(sums.windows_per_part());
    CHECK(count == window / span + 1);
    CHECK(count <= 64);
    CHECK((span == 1 || count > 32));
    for (int part = 0; part < count; ++part) {
      double expected = 0.0;
      for (int w = part * span; w < std::min((part + 1) * span, window + 1); ++w) expected += w;
      REQUIRE(sums.parts()[part].rows[0] == expected);
    }
  }
}

TEST_CASE("PartSums: of large grids there are fewer parts") {
  constexpr std::size_t kEight = PartSums<CellSums>::kMaxBytes / sizeof(double) / 8;
  PartSums<CellSums> sums;
  for (int window = 0; window < 8; ++window) sums.add(numbered(window, kEight));
  CHECK(sums.parts().size() == 8);
  sums.add(numbered(8, kEight));
  CHECK(sums.parts().size() == 5);
  CHECK(sums.parts()[4].rows[0] == 8.0);
}

TEST_CASE("Measurement: maps average to the profile, and their parts to the maps") {
  // These are linear in the sums. Averages over cells and time equal the averages of the whole.
  const std::vector<Field> linear = {
      Quantity::Density, Field(Quantity::Stress, 0, 1, Part::Collisional), Quantity::Dissipation};
  for (const Axis axis : {Axis::X, Axis::Y}) {
    const Measured result = measured(linear, axis);
    REQUIRE(result.maps);
    CHECK(result.maps->begin == result.burn_in);
    CHECK(result.maps->end == result.burn_in + result.duration);
    CHECK(result.maps->cell == std::vector{1.5, 2.0});
    CHECK(result.map_series.size() == 64);
    CHECK(result.map_series.front().begin == result.maps->begin);
    CHECK(result.map_series.back().end == result.maps->end);
    for (std::size_t f = 0; f < linear.size(); ++f) {
      const FieldMap& map = result.maps->maps[f];
      CHECK(map.field == linear[f]);
      CHECK(map.cells == std::vector{6, 4});
      const std::vector<Estimate>& profile = result.profile->at(linear[f]);
      for (int column = 0; column < static_cast<int>(profile.size()); ++column) {
        CHECK(column_mean(map, axis, column) ==
              doctest::Approx(profile[column].mean).epsilon(1e-12));
      }
      for (std::size_t cell = 0; cell < map.values.size(); ++cell) {
        double sum = 0.0;
        for (const FieldMaps& part : result.map_series) {
          sum += part.maps[f].values[cell] * (part.end - part.begin);
        }
        CHECK(sum / result.duration == doctest::Approx(map.values[cell]).epsilon(1e-10));
      }
    }
  }
}

TEST_CASE("Measurement: the mean velocity is taken from a temperature's map over the whole time") {
  // One particle, back and forth: at any time T = 0 relative to its velocity, and V = 0 on average.
  Scene scene = gas(10.0, 4.0, 1, 1.0);
  wall_in(scene, 0, {.kind = WallKind::Static});
  const auto simulation = lone_particle(scene, {5.0, 1.0}, {1.0, 0.0});
  Measure measure;
  measure.burn_in = 0.0;
  measure.fields = {Field(Quantity::Temperature, 0), Field(Quantity::Velocity, 0)};
  measure.cells = {1, 2};
  Measurement measurement(*simulation, measure, 36.0);
  simulation->run_until(36.0);  // two periods
  const Measured result = measurement.result();
  CHECK(result.maps->maps[0].values[0] == doctest::Approx(1.0));
  CHECK(result.maps->maps[1].values[0] == doctest::Approx(0.0));
  CHECK(result.map_series[0].maps[0].values[0] == doctest::Approx(0.0));
  CHECK(result.map_series[0].maps[1].values[0] == doctest::Approx(1.0));
  // The upper half is never visited: a gap.
  CHECK(std::isnan(result.maps->maps[0].values[1]));
  CHECK(std::isnan(result.map_series[0].maps[1].values[1]));
}
