#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("nothing moves at T = 0") {
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

TEST_CASE("walls that give nothing back: no drive, T_w = 0, restitution 0") {
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
