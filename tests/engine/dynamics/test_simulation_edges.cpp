#include <doctest/doctest.h>

#include <cmath>

#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("edges: no disk, and one disk") {
  Simulation<2> none(periodic_box(10.0, 10.0), State<2>{});
  none.run_until(1000.0);
  none.run_until(kNever, 1);
  CHECK(none.time() == 1000.0);
  CHECK(none.kinetic_energy() == 0.0);
  CHECK(none.state().positions.empty());

  State<2> start;
  start.positions = {{5.0, 5.0}};
  start.velocities = {{1.0, 0.25}};
  const Model<2> walled = with_walls(with_walls(periodic_box(10.0, 10.0), 0, Wall{}), 1, Wall{});
  Simulation<2> one(walled, start);
  one.run_until(180.0);  // to and fro over 9: 10 periods along x, 2.5 along y
  CHECK(one.counts().disk_wall == 25);
  CHECK((one.state().positions[0] - Vec2(5.0, 5.0)).norm() < 1e-12);
  CHECK(one.state().velocities[0] == Vec2(1.0, -0.25));
  check_sound(one);
}

TEST_CASE("edges: a free flight through many boxes") {
  for (const Vec2& v : {Vec2(1234.5, -0.375), Vec2(-3.0, 77.25), Vec2(-0.001, 0.0)}) {
    State<2> start;
    start.positions = {{2.25, 3.5}};
    start.velocities = {v};
    const Model<2> model = periodic_box(7.5, 5.0);
    Simulation<2> simulation(model, start);
    simulation.run_until(1234.75);
    const Vec2 r = simulation.state().positions[0];
    for (int k = 0; k < 2; ++k) {
      // Twice the rounding of the way, of which the box takes whole lengths.
      const double way = start.positions[0][k] + v[k] * 1234.75;
      const double off = std::remainder(r[k] - way, model.box[k]);
      CHECK(std::fabs(off) <= 0x1p-52 * std::fabs(way));
    }
    CHECK(finite_and_inside(model, simulation.state()));
    check_sound(simulation);
  }
}

TEST_CASE("edges: two disks that move alike never meet, however far they fly") {
  State<2> start;
  start.positions = {{1.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}};
  start.velocities = {{50.0, -31.0}, {50.0, -31.0}, {50.0, -31.0}};
  Simulation<2> simulation(periodic_box(4.0, 6.0), start);
  simulation.run_until(1000.0);
  CHECK(simulation.counts().disk_disk == 0);
  CHECK(simulation.counts().cell_crossings > 20000);
  CHECK(simulation.deepest_overlap() < 1e-10);  // positions at 1000 are of order 5e4
}

TEST_CASE("edges: Newton's cradle of ten hands on the velocity to the last bit") {
  State<2> start;
  for (int i = 0; i < 11; ++i) {
    start.positions.push_back({i == 0 ? 2.0 : 4.0 + i, 3.0});
    start.velocities.push_back({i == 0 ? 0.7 : 0.0, 0.0});
  }
  Simulation<2> simulation(periodic_box(40.0, 6.0), start);
  simulation.run_until(2.8);  // the gap of 2 closes at 2 / .7 = 2.857
  CHECK(simulation.counts().disk_disk == 0);
  simulation.run_until(3.0);
  CHECK(simulation.counts().disk_disk == 10);
  const State<2> state = simulation.state();
  for (int i = 0; i < 10; ++i) {
    CHECK(state.velocities[static_cast<std::size_t>(i)] == Vec2(0.0, 0.0));
    CHECK(state.positions[static_cast<std::size_t>(i)].x() == doctest::Approx(4.0 + i));
  }
  CHECK(state.velocities[10] == Vec2(0.7, 0.0));
  check_sound(simulation);
}

TEST_CASE("edges: wholly inelastic disks collide once and move on together") {
  int collisions = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Model<2> model = periodic_box(9.0, 8.0);
    model.restitution = 0.0;
    Simulation<2> simulation(model, random_gas(model, 2, seed));
    simulation.run_until(1000.0);
    // Without tangential losses a pair may meet again after a turn round the box.
    collisions += static_cast<int>(simulation.counts().disk_disk);
    REQUIRE(simulation.counts().disk_disk < 1000);
    REQUIRE(finite_and_inside(model, simulation.state()));
    check_sound(simulation);
  }
  CHECK(collisions > 200);
}

TEST_CASE("edges: nothing moves at T = 0") {
  const Wall driven{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.0};
  const Model<2> model = with_walls(periodic_box(9.0, 8.0), 0, driven);
  State<2> start = random_gas(model, 20, 121);
  for (Vec2& v : start.velocities) v.setZero();
  Simulation<2> simulation(model, start);
  const std::uint64_t before = simulation.state_hash();
  simulation.run_until(100.0);
  simulation.run_until(kNever, 1);
  CHECK(simulation.state_hash() == before);
  CHECK(simulation.time() == 100.0);
  CHECK(simulation.counts().disk_wall + simulation.counts().disk_disk == 0);
}

TEST_CASE("edges: walls that give nothing back: no drive, T_w = 0, restitution 0") {
  const Wall walls[] = {{.kind = WallKind::Driven, .drive_speed = 0.0},
                        {.kind = WallKind::Driven, .restitution = 0.0, .drive_speed = 0.0},
                        {.kind = WallKind::Thermal, .temperature = 0.0}};
  for (const Wall& wall : walls) {
    const Model<2> model = with_walls(with_walls(periodic_box(9.0, 8.0), 0, wall), 1, wall);
    const State<2> start = random_gas(model, 20, 122);
    Simulation<2> simulation(model, start);
    const double energy = simulation.kinetic_energy();
    simulation.run_until(100.0);
    const bool elastic = wall.kind == WallKind::Driven && wall.restitution == 1.0;
    if (elastic) CHECK(std::fabs(simulation.kinetic_energy() / energy - 1.0) < 1e-12);
    if (!elastic) CHECK(simulation.kinetic_energy() < 0.1 * energy);
    CHECK(finite_and_inside(model, simulation.state()));
    CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
    check_sound(simulation);
  }
}

TEST_CASE("edges: a start with overlap is refused, one that touches is not") {
  const Model<2> model = with_walls(periodic_box(9.0, 8.0), 0, Wall{});
  const auto start = [](Vec2 a, Vec2 b) { return State<2>{{a, b}, {Vec2::Zero(), Vec2::Zero()}}; };
  CHECK_NOTHROW(Simulation<2>(model, start({2.0, 3.0}, {3.0, 3.0})));
  CHECK_NOTHROW(Simulation<2>(model, start({0.5, 3.0}, {8.5, 3.0})));
  CHECK_THROWS_AS(Simulation<2>(model, start({2.0, 3.0}, {2.999, 3.0})), PhysicalStop);
  CHECK_THROWS_AS(Simulation<2>(model, start({2.0, 0.2}, {2.0, 7.5})), PhysicalStop);
  CHECK_THROWS_AS(Simulation<2>(model, start({0.4, 3.0}, {5.0, 3.0})), PhysicalStop);
  CHECK_THROWS_AS(Simulation<2>(model, start({2.0, 3.0}, {8.6, 3.0})), PhysicalStop);
}

// Dropped from rest at the border of two cells, an elastic disk turns there again and again, above
// or below it by rounding; so late on the base that it may cross twice at one time.
TEST_CASE("edges: a disk that falls and turns on a border of its cell") {
  for (const double height : {1.5, 2.0, 3.0, 4.0, 5.25}) {
    Model<2> model = with_walls(periodic_box(8.0, 8.0), 1, Wall{});
    model.gravity = {0.0, -1.0};
    State<2> start;
    start.positions = {{2.0, height}, {6.0, 0.5 + (height - 0.5) / 4.0}};
    start.velocities = {{0.0, 0.0}, {0.0, 0.0}};
    Simulation<2> simulation(model, start);
    simulation.run_until(20000.0);
    CHECK(simulation.counts().disk_wall > 5000);
    CHECK(simulation.kinetic_energy() <= height);
    check_sound(simulation);
  }
}
