#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/initial/mixture_state.h"
#include "engine/live/live_profile.h"
#include "engine/measure/fields.h"
#include "engine/measure/residuals.h"
#include "engine/picture/live_field.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/measure/sums.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

View view_of(Field field, double window) {
  View view;
  view.field = field;
  view.window = window;
  return view;
}

// Whether two maps have the same numbers and gaps.
bool same(const FieldMap& a, const FieldMap& b) {
  return std::ranges::equal(a.values, b.values, [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  });
}

FieldMap map_of(LiveField<2>& live) {
  Snapshot snapshot;
  live.publish(snapshot);
  return *snapshot.field;
}

}  // namespace

TEST_CASE("LiveField: every field is the average of its cells over the window") {
  Scene scene = rough_mixture(20);
  scene.particles.roughness.friction = 0.4;
  for (const Field field : average_fields()) {
    CAPTURE(name_of(field));
    const auto simulation = simulation_of<2>(scene, 34);
    LiveField<2> live(*simulation, view_of(field, 2.0));
    CellIntegrals<2> integrals(*simulation, {9, 8}, full_layout());
    simulation->add_observer(integrals);
    simulation->run_until(0.3);
    map_of(live);
    simulation->run_until(1.9);
    const FieldMap map = map_of(live);
    const CellSums sums = integrals.close_window();
    REQUIRE(map.field == field);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      CAPTURE(i);
      const double expected = field_value(field, averages_of(integrals.layout(), sums, i, 1.0));
      CHECK(std::isnan(map.values[i]) == std::isnan(expected));
      if (!std::isnan(expected)) CHECK(std::fabs(map.values[i] - expected) < 1e-10);
    }
  }
}

TEST_CASE("LiveField: of snapshots it is the average of samples, also across changes of laws") {
  const Scene scene = gas(12.0, 8.0, 30, 0.9);
  View view = view_of(Quantity::Temperature, 2.0);
  view.estimator = Estimator::Snapshot;
  view.interval = 0.25;
  const auto simulation = simulation_of<2>(scene, 41);
  LiveField<2> live(*simulation, view);
  CellIntegrals<2> integrals(*simulation, {12, 8}, full_layout(), {Estimator::Snapshot, {}});
  // Samples of the times 0, 0.25, ..., 1.75.
  for (int i = 0; i < 8; ++i) {
    simulation->run_until(0.25 * i);
    integrals.sample();
  }
  simulation->run_until(1.0 + 0.9);
  const CellSums sums = integrals.close_window();
  const FieldMap map = map_of(live);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    CAPTURE(i);
    const double expected =
        field_value(Quantity::Temperature, averages_of(integrals.layout(), sums, i, 1.0));
    CHECK(std::isnan(map.values[i]) == std::isnan(expected));
    if (!std::isnan(expected)) CHECK(std::fabs(map.values[i] - expected) < 1e-10);
  }
  // It continues with the next sample, after a hand-over or a save.
  const std::string saved = live.save();
  Simulation<2> next(simulation->model(), simulation->save());
  LiveField<2> handed(next, view, std::move(live));
  Simulation<2> again(simulation->model(), simulation->save());
  LiveField<2> read(again, view, ArchiveReader(saved, "averages"));
  next.run_until(3.1);
  again.run_until(3.1);
  CHECK(same(map_of(handed), map_of(read)));
}

TEST_CASE("LiveField: every residual belongs to its cells over the window") {
  Scene scene = rough_mixture(20);
  scene.particles.roughness.friction = 0.4;
  scene.gravity = Vec2(0.2, -0.5);
  // 20 particles in 72 cells: some cells are never visited.
  for (const Field field : residual_fields(2)) {
    CAPTURE(name_of(field));
    const auto simulation = simulation_of<2>(scene, 35);
    LiveField<2> live(*simulation, view_of(field, 8.0));
    Balance<2> balance(*simulation, {9, 8});
    simulation->add_observer(balance);
    simulation->run_until(0.4);
    map_of(live);
    Imbalances<2> sum = balance.close_window().imbalances;
    simulation->run_until(0.9);
    sum += balance.close_window().imbalances;
    const FieldMap map = map_of(live);
    REQUIRE(map.field == field);
    REQUIRE(map.values.size() == 72);
    double largest = 0.0;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      CHECK(std::isnan(map.values[i]) == (sum.sizes[i].maxCoeff() == 0.0));
      if (std::isnan(map.values[i])) continue;
      CHECK(map.values[i] == sum.residual(i)[equation_of(field, 2)]);
      largest = std::max(largest, std::fabs(map.values[i]));
    }
    CHECK(largest < 1e-12);
    CHECK((largest > 0.0) == (field != Quantity::BalanceMass));
    CHECK(std::ranges::any_of(map.values, [](double value) { return std::isnan(value); }));
  }
}

TEST_CASE("LiveField: cells that no particle visited are gaps, without arrows") {
  const auto simulation = lone_particle(gas(6.0, 4.0, 1, 1.0), {0.5, 2.5}, {1.0, 0.0});
  View view = view_of(Field(Quantity::Velocity, 0), 100.0);
  view.arrows = Quantity::Velocity;
  LiveField<2> live(*simulation, view);
  Snapshot snapshot;
  live.publish(snapshot);  // no time has passed
  CHECK(std::isnan(snapshot.field->values[12]));
  CHECK(snapshot.arrows->arrows.empty());
  simulation->run_until(3.0);  // visits the columns 0 to 3 of row 2
  live.publish(snapshot);
  for (std::size_t i = 0; i < snapshot.field->values.size(); ++i) {
    CAPTURE(i);
    const double value = snapshot.field->values[i];
    CHECK((i >= 12 && i < 16 ? value == doctest::Approx(1.0) : std::isnan(value)));
  }
  REQUIRE(snapshot.arrows->arrows.size() == 4);
  for (int column = 0; column < 4; ++column) {
    CHECK(snapshot.arrows->arrows[column].place == Vec2(column + 0.5, 2.5));
    CHECK((snapshot.arrows->arrows[column].value - Vec2(1.0, 0.0)).norm() < 1e-12);
  }
}

TEST_CASE("LiveField: the window reaches back by its length and by one part more at most") {
  // One particle of speed 1 in a row of 16 cells leaves its density in the columns of the last 4
  // time units. Parts last 0.5.
  const auto simulation = lone_particle(gas(16.0, 1.0, 1, 1.0), {0.0, 0.5}, {1.0, 0.0});
  LiveField<2> live(*simulation, view_of(Quantity::Density, 4.0));
  const auto check = [&](double now, double reaches_back) {
    simulation->run_until(now);
    const FieldMap map = map_of(live);
    CHECK(map.whole_window == (now >= 4.0));
    for (int column = 0; column < 16; ++column) {
      const double inside =
          std::min(column + 1.0, now) - std::max<double>(column, now - reaches_back);
      CAPTURE(now);
      CAPTURE(column);
      CHECK(std::fabs(map.values[column] - std::max(0.0, inside) / reaches_back) < 1e-12);
    }
  };
  check(1.25, 1.25);  // shorter than the window: since the start
  check(4.0, 4.0);
  check(4.25, 4.25);
  check(12.0, 4.0);
  check(12.25, 4.25);  // eight parts and the current one
  check(12.45, 4.45);
}

TEST_CASE("LiveField: it has at most 512 cells along an axis, and at least one") {
  const auto simulation = lone_particle(gas(2000.0, 1.2, 1, 1.0), {0.5, 0.5}, {1.0, 0.0});
  LiveField<2> live(*simulation, view_of(Quantity::Density, 1.0));
  CHECK(map_of(live).cells == std::vector{512, 1});
}

TEST_CASE("LiveField: a large intruder does not widen the cells") {
  Model<2> model;
  model.box = {20.0, 10.0};
  model.diameter = 5.0;
  model.species = SpeciesLaws<2>{.pairs = std::vector<PairLaw>(4), .walls = {{}, {}}};
  std::vector<Grain> grains(39);
  grains.push_back({.radius = 2.5, .mass = 25.0, .species = 1});
  Simulation<2> simulation(model, mixture_state<2>(model, grains, 1.0, 31));
  LiveField<2> live(simulation, view_of(Quantity::Density, 1.0));
  CHECK(map_of(live).cells == std::vector{18, 9});  // mean diameter 1.1
  const LiveProfile<2> profile(simulation, 0.1, Axis::X);
  simulation.run_until(0.25);
  CHECK(profile.profile().edges.size() == 18 + 1);
}

TEST_CASE("LiveField: arrows are the vector field of blocks of cells") {
  // 21 x 8 cells make blocks of 2 x 2, and narrower ones at the right.
  const Scene scene = gas(21.0, 8.0, 60, 1.0);
  for (const Quantity quantity : {Quantity::Velocity, Quantity::HeatFlux}) {
    CAPTURE(static_cast<int>(quantity));
    const auto simulation = simulation_of<2>(scene, 35);
    View view;
    view.arrows = quantity;
    view.window = 50.0;
    LiveField<2> live(*simulation, view);
    CellIntegrals<2> integrals(*simulation, {21, 8}, full_layout());
    simulation->add_observer(integrals);
    simulation->run_until(5.0);
    Snapshot snapshot;
    live.publish(snapshot);
    CHECK_FALSE(snapshot.field);
    REQUIRE(snapshot.arrows);
    CHECK(snapshot.arrows->quantity == quantity);
    CHECK(snapshot.arrows->cell == Vec2(2.0, 2.0));
    REQUIRE(snapshot.arrows->arrows.size() == 11 * 4);

    const CellSums sums = integrals.close_window();
    const auto size = static_cast<std::size_t>(integrals.layout().size);
    for (std::size_t k = 0; k < snapshot.arrows->arrows.size(); ++k) {
      CAPTURE(k);
      const int column = static_cast<int>(k % 11), row = static_cast<int>(k / 11);
      const int width = column < 10 ? 2 : 1;
      std::vector<double> block(size);
      for (int y = 2 * row; y < 2 * row + 2; ++y) {
        for (int x = 2 * column; x < 2 * column + width; ++x) {
          for (std::size_t i = 0; i < size; ++i) {
            block[i] += sums.rows[size * (x + 21 * y) + i] / (sums.time * 2.0 * width);
          }
        }
      }
      const auto averages = averages_of(integrals.layout(), block.data());
      const Vec2 expected(field_value(Field(quantity, 0), averages),
                          field_value(Field(quantity, 1), averages));
      const auto& arrow = snapshot.arrows->arrows[k];
      CHECK((arrow.value - expected).norm() < 1e-10);
      CHECK(arrow.place == Vec2(2.0 * column + 0.5 * width, 2.0 * row + 1.0));
    }
  }
}

TEST_CASE("LiveField: of spheres, cells and arrows fill the box") {
  const Scene scene = rough_spheres(30);
  const auto simulation = simulation_of<3>(scene, 37);
  View view;
  view.field = Field(Quantity::Stress, 1, 2);
  view.arrows = Quantity::Velocity;
  view.window = 50.0;
  LiveField<3> live(*simulation, view);
  const std::vector<Field> all = all_fields(3);
  CellIntegrals<3> integrals(*simulation, {6, 5, 7}, moment_layout<3>(all, true, false));
  simulation->add_observer(integrals);
  simulation->run_until(5.0);
  Snapshot snapshot;
  live.publish(snapshot);
  const CellSums sums = integrals.close_window();
  REQUIRE(snapshot.field);
  CHECK(snapshot.field->cells == std::vector<int>{6, 5, 7});
  REQUIRE(snapshot.arrows);
  CHECK(snapshot.arrows->cell == Vec<3>(1.0, 1.0, 1.0));
  std::size_t arrow = 0, known = 0;
  for (std::size_t cell = 0; cell < 6 * 5 * 7; ++cell) {
    const auto averages = averages_of(integrals.layout(), sums, cell, 1.0);
    const double stress = field_value(*view.field, averages), shown = snapshot.field->values[cell];
    CHECK(std::isnan(shown) == std::isnan(stress));
    if (!std::isnan(stress)) CHECK(shown == doctest::Approx(stress).epsilon(1e-9));
    Vec<3> velocity;
    for (int axis = 0; axis < 3; ++axis) {
      velocity[axis] = field_value(Field(Quantity::Velocity, axis), averages);
    }
    if (velocity.hasNaN()) continue;
    ++known;
    REQUIRE(arrow < snapshot.arrows->arrows.size());
    const auto& [place, value] = snapshot.arrows->arrows[arrow++];
    CHECK((value - velocity).norm() < 1e-9);
    CHECK(place == integrals.grid().centre_of(integrals.grid().cell_of(cell)));
  }
  CHECK(arrow == snapshot.arrows->arrows.size());
  CHECK(known > 50);
}

TEST_CASE("LiveField: a residual and arrows do not change each other") {
  const auto shown = [](std::optional<Field> field, std::optional<Quantity> arrows) {
    const auto simulation = simulation_of<2>(rough_mixture(20), 36);
    View view;
    view.field = field;
    view.arrows = arrows;
    view.window = 2.0;
    LiveField<2> live(*simulation, view);
    simulation->run_until(2.1);
    Snapshot snapshot;
    live.publish(snapshot);
    return snapshot;
  };
  const Snapshot both = shown(Quantity::BalanceEnergy, Quantity::Velocity);
  const FieldMap residual = *shown(Quantity::BalanceEnergy, std::nullopt).field;
  const ArrowMap arrows = *shown(std::nullopt, Quantity::Velocity).arrows;
  REQUIRE(both.field);
  REQUIRE(both.arrows);
  CHECK(both.field->field == Quantity::BalanceEnergy);
  CHECK(both.field->whole_window);
  CHECK(same(*both.field, residual));
  REQUIRE(both.arrows->arrows.size() == arrows.arrows.size());
  for (std::size_t k = 0; k < arrows.arrows.size(); ++k) {
    CHECK(both.arrows->arrows[k].value == arrows.arrows[k].value);
  }
}

// The gas moves with the flow G (y - 4): at rest in the middle, and at 0.9 of -+4 G in the outer
// cells, whose centres are 0.5 from the edges. The mean of N particles in a row scatters.
TEST_CASE("LiveField: arrows of a sheared box include the flow, and fields do not") {
  Scene scene = gas(40.0, 8.0, 100, 0.9);
  scene.shear_rate = 2.0;
  const auto simulation = simulation_of<2>(scene, 36);
  View view = view_of({Quantity::Velocity, 0}, 50.0);
  view.arrows = Quantity::Velocity;
  LiveField<2> live(*simulation, view);
  simulation->run_until(50.0);
  Snapshot snapshot;
  live.publish(snapshot);
  const double thermal = std::sqrt(simulation->temperature());
  double largest = 0.0;
  for (const double value : snapshot.field->values) largest = std::max(largest, std::fabs(value));
  CHECK(largest < thermal);
  for (const auto& arrow : snapshot.arrows->arrows) {
    const double flow = 2.0 * (arrow.place[1] - 4.0);
    CHECK(std::fabs(arrow.value[0] - flow) < thermal);
  }
  REQUIRE(snapshot.arrows->arrows.size() >= 20);
  // Under another rate, as during a ramp, they show its flow.
  scene.shear_rate = -1.0;
  simulation->set_laws(model_of<2>(scene, 36));
  live.publish(snapshot);
  for (const auto& arrow : snapshot.arrows->arrows) {
    CHECK(std::fabs(arrow.value[0] + (arrow.place[1] - 4.0)) < thermal);
  }
}
