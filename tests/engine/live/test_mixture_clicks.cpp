// Clicks of particles of different masses.

#include <doctest/doctest.h>

#include <cmath>

#include "engine/live/click_recorder.h"
#include "tests/engine/support/models.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// A particle of mass 1 and radius 1/2 at rest between two walls, and one of mass 4 and radius 1
// that hits it along x with speed 3 at x = 4.5. All collisions are elastic.
template <int D>
std::vector<Click> clicks_of_pair() {
  Model<D> model = with_walls<D>(periodic_box<D>(Vec<D>::Constant(10.0)), 0, Wall{});
  model.diameter = 2.0;
  State<D> state;
  Vec<D> place = Vec<D>::Constant(5.0), heavy = place;
  heavy[0] = 2.0;
  state.positions = {place, heavy};
  state.velocities = {Vec<D>::Zero(), 3.0 * Vec<D>::Unit(0)};
  state.grains = {{}, {.radius = 1.0, .mass = 4.0}};
  Simulation<D> simulation(model, state);
  ClickRecorder<D> recorder(simulation);
  simulation.run_until(1.5);
  return recorder.take();
}

template <int D>
void check_pair() {
  const std::vector<Click> clicks = clicks_of_pair<D>();
  REQUIRE(clicks.size() == 2);
  // Reduced mass 0.8, impulse 2 0.8 3 = 4.8, energy 0.8 3^2 / 2.
  CHECK(clicks[0].time == doctest::Approx(0.5));
  CHECK(clicks[0].place == doctest::Approx(0.45));
  CHECK(clicks[0].energy == doctest::Approx(3.6));
  CHECK(clicks[0].frequency == doctest::Approx(4.8 / std::pow(1.6, 1.0 + 1.0 / D)));
  // The light particle flies with 4.8 to the wall and gains 9.6; its mass is 1.
  CHECK(clicks[1].time == doctest::Approx(0.5 + 4.5 / 4.8));
  CHECK(clicks[1].place == doctest::Approx(0.95));
  CHECK(clicks[1].energy == doctest::Approx(0.5 * 4.8 * 4.8));
  CHECK(clicks[1].frequency == doctest::Approx(9.6));
}

}  // namespace

TEST_CASE("Mixture clicks: energy and frequency have the masses of both partners") {
  check_pair<2>();
  check_pair<3>();
}

TEST_CASE("Mixture clicks: at equal speeds a heavy particle sounds lower at a wall") {
  Model<2> model = with_walls(periodic_box(10.0, 10.0), 0, Wall{});
  model.diameter = 2.0;
  const auto frequency_of = [&](double mass) {
    State<2> state{{Vec2(5.0, 5.0)}, {Vec2(2.0, 0.0)}};
    state.grains = {{.radius = 1.0, .mass = mass}};
    Simulation<2> simulation(model, state);
    ClickRecorder<2> recorder(simulation);
    simulation.run_until(2.5);
    const std::vector<Click> clicks = recorder.take();
    REQUIRE(clicks.size() == 1);
    return clicks[0].frequency;
  };
  CHECK(frequency_of(1.0) == doctest::Approx(4.0));
  // A disk of four times the mass has twice the diameter.
  CHECK(frequency_of(4.0) == doctest::Approx(2.0));
}
