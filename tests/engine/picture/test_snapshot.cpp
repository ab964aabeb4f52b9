#include <doctest/doctest.h>

#include <cmath>

#include "engine/picture/snapshot.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("Snapshot: it has the state to the last bit") {
  const Scene scene = rough_mixture(20);
  const auto simulation = simulation_of<2>(scene, 51);
  for (int frame = 0; frame < 50; ++frame) {
    simulation->run_until(0.37 * frame);
    const Snapshot snapshot = snapshot_of(*simulation);
    const State<2> state = simulation->state();
    // The moving base costs one rounding.
    CHECK(std::fabs(snapshot.time - 0.37 * frame) <= 4e-16 * snapshot.time);
    CHECK(snapshot.positions == as_columns(state.positions));
    CHECK(snapshot.velocities == as_columns(state.velocities));
    CHECK(snapshot.temperature == simulation->kinetic_energy() / 20.0);
    CHECK(snapshot.collisions == simulation->counts().pair_collisions);
    CHECK_FALSE(snapshot.field);
  }
}

TEST_CASE("Snapshot: of spheres it has three coordinates, six walls and vector spins") {
  const Scene scene = rough_spheres(20);
  const auto simulation = simulation_of<3>(scene, 54);
  simulation->run_until(3.0);
  const Snapshot snapshot = snapshot_of(*simulation);
  const State<3> state = simulation->state();
  CHECK(snapshot.box == scene.box);
  CHECK(snapshot.positions == as_columns(state.positions));
  CHECK(snapshot.velocities == as_columns(state.velocities));
  CHECK(snapshot.spins == as_columns(state.spins));
  CHECK(snapshot.count() == 20);
  CHECK(snapshot.temperature == doctest::Approx(snapshot.velocities.squaredNorm() / 60.0));
  for (int side = 0; side < 6; ++side) {
    REQUIRE(snapshot.walls[side]);
    CHECK(snapshot.walls[side]->kind == scene.walls[side]->kind);
    CHECK(snapshot.wall_displacement[side] == simulation->wall(side).displacement);
  }
  CHECK(snapshot.wall_displacement[kFront] != 0.0);
}

TEST_CASE("Snapshot: moving walls are displaced, the others not") {
  Scene scene = gas(9.0, 8.0, 1, 1.0);
  scene.walls[kLeft] = Wall{.kind = WallKind::Sawtooth, .stroke = 0.5, .frequency = 0.25};
  scene.walls[kRight] = Wall{};
  scene.walls[kBottom] = scene.walls[kTop] =
      Wall{.kind = WallKind::Sinusoidal, .stroke = 0.5, .frequency = 0.25, .phase = 0.5};
  const auto simulation = simulation_of<2>(scene, 53);
  simulation->run_until(1.0);
  const Snapshot snapshot = snapshot_of(*simulation);
  CHECK(snapshot.wall_displacement[kLeft] == doctest::Approx(0.125));
  CHECK(snapshot.wall_displacement[kRight] == 0.0);
  CHECK(snapshot.wall_displacement[kBottom] == doctest::Approx(-0.25));
  CHECK(snapshot.wall_displacement[kTop] == doctest::Approx(-0.25));
}

TEST_CASE("Snapshot: centres are in the box for any start of their flights") {
  const auto simulation = lone_particle(gas(5.0, 4.0, 1, 1.0), {0.5, 3.5}, {-3.0, 7.0});
  simulation->run_until(1.25);  // at (-3.25, 12.25): one box back, three boxes up
  const Snapshot snapshot = snapshot_of(*simulation);
  CHECK(snapshot.positions.col(0) == Vec2(1.75, 0.25));
}

TEST_CASE("Snapshot: of a mixture it has what the particles are, and the species of the scene") {
  const Scene scene = parse_scene(R"(
      box.size = [12, 9]
      [[species]]
      name = "small"
      count = 20
      [[species]]
      name = "large"
      count = 3
      diameter = 2.0
      colour = "#c03030"
      [view]
      colour_by = "species")",
                                  "mixture");
  CHECK(scene.view.colour_by == ColourBy::Species);
  ScheduledRun<2> run(scene, 1);
  run.run_until(1.0);
  const Snapshot snapshot = run.snapshot();
  REQUIRE(snapshot.grains.size() == 23);
  CHECK(snapshot.diameter == 2.0);
  CHECK(snapshot.smallest_radius() == 0.5);
  for (std::uint32_t i = 0; i < 23; ++i) {
    CHECK(snapshot.grains[i] == run.simulation().grain(i));
    CHECK(snapshot.radius(i) == (snapshot.grains[i].species == 1 ? 1.0 : 0.5));
  }
  REQUIRE(snapshot.species.size() == 2);
  CHECK(snapshot.species[0].name == "small");
  CHECK(snapshot.species[1].colour == Rgb{0xc0, 0x30, 0x30});
}

TEST_CASE("Snapshot: of particles that are alike it stores neither grains nor species") {
  ScheduledRun<2> run(gas(9.0, 8.0, 5, 1.0), 1);
  const Snapshot snapshot = run.snapshot();
  CHECK(snapshot.grains.empty());
  CHECK(snapshot.species.empty());
  CHECK(snapshot.radius(3) == 0.5);
  CHECK(snapshot.smallest_radius() == 0.5);
}
