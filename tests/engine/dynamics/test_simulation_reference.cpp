#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

struct Case {
  std::string name;
  Model<2> model;
  std::vector<int> counts;  // numbers of particles
};

// The state after 2000 collisions must be that of the reference to the last bit.
void compare(const Model<2>& model, const State<2>& start, std::uint64_t collisions = 2000) {
  Simulation<2> simulation(model, start);
  const BaseMoves moves(simulation);
  Reference reference(model, start, moves);
  simulation.run_until(kNever, collisions);
  reference.run_until_collisions(collisions);
  CHECK(simulation.counts().pair_collisions == reference.collisions());
  CHECK(simulation.counts().wall_collisions == reference.wall_hits());
  CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
  CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
  check_sound(simulation);
}

void compare(const Case& c) {
  for (const int count : c.counts) {
    CAPTURE(c.name);
    CAPTURE(count);
    compare(c.model, random_gas(c.model, count, 81));
  }
}

}  // namespace

TEST_CASE("Reference: gases in periodic boxes have the same bits") {
  compare({"wide", periodic_box(9.0, 8.0), {2, 3, 7, 16, 30}});
  compare({"dense", periodic_box(6.2, 6.1), {30}});
  compare({"one particle high: contacts through images that are not the nearest",
           periodic_box(12.0, 1.2),
           {2, 3, 6}});
  compare({"two particles high", periodic_box(7.0, 2.05), {2, 5, 9}});
  compare({"two cells wide", periodic_box(2.2, 9.0), {2, 8, 12}});
  compare({"one cell in all", periodic_box(1.9, 2.05), {2}});
  compare({"inelastic", inelastic(periodic_box(9.0, 8.0), 0.9), {2, 12, 30}});
}

TEST_CASE("Reference: walls on two sides and on four give the same bits") {
  compare({"static", with_walls(periodic_box(9.0, 8.0), 0, kStatic), {2, 12, 30}});
  compare({"four static",
           with_walls(with_walls(periodic_box(7.0, 8.0), 0, kStatic), 1, kStatic),
           {2, 12, 30}});
  compare(
      {"driven", inelastic(with_walls(periodic_box(9.0, 8.0), 0, kDriven), 0.9), {2, 3, 12, 30}});
  compare({"driven, lossy across",
           inelastic(with_walls(with_walls(periodic_box(9.0, 8.0), 0, kDriven), 1, kLossy), 0.8),
           {2, 3, 12, 30}});
  compare(
      {"thermal", inelastic(with_walls(periodic_box(9.0, 8.0), 1, kThermal), 0.7), {2, 3, 12, 30}});
  compare({"driven, periodic across and narrow",
           inelastic(with_walls(periodic_box(12.0, 1.2), 0, kDriven), 0.9),
           {2, 5}});
  compare({"thermal, periodic across and two particles high",
           inelastic(with_walls(periodic_box(9.0, 2.05), 0, kThermal), 0.9),
           {2, 5, 12}});
  compare({"a channel that holds one particle across",
           with_walls(periodic_box(12.0, 1.5), 1, kStatic),
           {2, 6}});
}

TEST_CASE("Reference: wholly inelastic particles between driven walls have the same bits") {
  const Model<2> model = inelastic(with_walls(periodic_box(9.0, 8.0), 0, kDriven), 0.0);
  for (const int count : {2, 5, 20}) compare(model, random_gas(model, count, 82));
}

// Particles on a square lattice, four velocities that repeat: several pairs collide at the same
// times.
TEST_CASE("Reference: simultaneous collisions happen in the same order") {
  for (const bool walled : {false, true}) {
    for (const double restitution : {1.0, 0.5}) {
      Model<2> model = inelastic(periodic_box(8.0, 8.0), restitution);
      if (walled) model = with_walls(with_walls(model, 0, kDriven), 1, kStatic);
      State<2> start;
      for (int i = 0; i < 16; ++i) {
        const Vec2 directions[] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
        start.positions.push_back({1.0 + 2.0 * (i % 4), 1.0 + 2.0 * (i / 4)});
        start.velocities.push_back(directions[(i + i / 4) % 4]);
      }
      compare(model, start);
    }
  }
}

// The second particle crosses the box some hundred times before it meets the first.
TEST_CASE("Reference: a first contact after many box lengths is found") {
  const Model<2> model = periodic_box(10.0, 9.0);
  State<2> start;
  start.positions = {{1.0, 1.0}, {4.0, 6.0}};
  start.velocities = {{0.0, 0.0}, {1.0, -0.001}};
  Simulation<2> simulation(model, start);
  const BaseMoves moves(simulation);
  Reference reference(model, start, moves);
  simulation.run_until(kNever, 1);
  reference.run_until_collisions(1);
  CHECK(simulation.time() > 1000.0);
  CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
  check_sound(simulation);
}
