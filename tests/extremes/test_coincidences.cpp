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

TEST_CASE("Coincidences: Newton's cradle of ten touching particles between walls" *
          doctest::description("exact to the last bit for fifty passes, overlap 0")) {
  // Every number is a multiple of 1/4, so that nothing is rounded. The eleventh particle flies 2
  // and passes its velocity on through ten touching particles. The last flies 3 to the wall and 3
  // back, and so on.
  constexpr int kParticles = 11;
  constexpr double kSpeed = 0.5;
  Model<2> model = with_walls(periodic_box(16.5, 6.0), 0, kStatic);
  State<2> start;
  for (int i = 0; i < kParticles; ++i) {
    start.positions.push_back({i == 0 ? 0.5 : 2.5 + i, 3.0});
    start.velocities.push_back({i == 0 ? kSpeed : 0.0, 0.0});
  }
  // Particles at rest: 0 at 2.5 after the first pass, ..., 10 at 12.5 or under way to 16 and back.
  Simulation<2> simulation(model, start);
  for (int pass = 0; pass < 50; ++pass) {
    CAPTURE(pass);
    // Half a time unit after the pass to the right, then after the pass to the left.
    const double there = 22.0 * pass + 4.0 + 0.5;
    simulation.run_until(there);
    State<2> state = simulation.state();
    for (int i = 0; i < kParticles; ++i) {
      const bool last = i == kParticles - 1;
      REQUIRE(state.positions[i] == Vec2(2.5 + i + (last ? 0.25 : 0.0), 3.0));
      REQUIRE(state.velocities[i] == Vec2(last ? kSpeed : 0.0, 0.0));
    }
    REQUIRE(simulation.counts().pair_collisions == 20U * pass + 10U);
    simulation.run_until(22.0 * pass + 4.0 + 14.0 + 0.5);
    state = simulation.state();
    for (int i = 0; i < kParticles; ++i) {
      REQUIRE(state.positions[i] == Vec2(2.5 + i - (i == 0 ? 0.25 : 0.0), 3.0));
      REQUIRE(state.velocities[i] == Vec2(i == 0 ? -kSpeed : 0.0, 0.0));
    }
    REQUIRE(simulation.counts().pair_collisions == 20U * pass + 20U);
  }
  CHECK(simulation.checks().deepest_overlap == 0.0);
  CHECK(simulation.checks().clock_steps_back == 0.0);
  MESSAGE(simulation.counts().pair_collisions, " collisions, overlap ",
          brief(simulation.checks().deepest_overlap));
}

namespace {

// Compares with brute force. Ties have a defined order.
void compare_by_brute_force(const Model<2>& model, const State<2>& start,
                            std::uint64_t collisions) {
  Simulation<2> simulation(model, start);
  const BaseMoves<2> moves(simulation);
  Reference<2> reference(model, start, moves);
  simulation.run_until(kNever, collisions);
  reference.run_until_collisions(collisions);
  CHECK(simulation.counts().collisions() == collisions);
  CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
  check_sound(simulation);
}

double energy_of(const State<2>& state) {
  double twice = 0.0;
  for (const Vec2& v : state.velocities) twice += v.squaredNorm();
  return 0.5 * twice;
}

}  // namespace

TEST_CASE("Coincidences: a lattice whose rows and columns all meet at once" *
          doctest::description("the same bits by brute force; energy and momentum within "
                               "1e-13")) {
  // Neighbours approach along x, or rest: 32 collisions at each of the first times.
  const Model<2> model = periodic_box(16.0, 12.0);
  State<2> start;
  for (int i = 0; i < 48; ++i) {
    const int column = i % 8, row = i / 8;
    start.positions.push_back({1.0 + 2.0 * column, 1.0 + 2.0 * row});
    start.velocities.push_back({column % 2 ? -1.0 : 1.0, row % 3 == 2 ? 0.5 : -0.25});
  }
  compare_by_brute_force(model, start, 2000);
  Simulation<2> simulation(model, start);
  simulation.run_until(kNever, 2000);
  const State<2> end = simulation.state();
  const double energy_off = std::fabs(energy_of(end) / energy_of(start) - 1.0);
  const double momentum_off = (momentum(end) - momentum(start)).norm() / 48.0;
  MESSAGE("energy off by ", brief(energy_off), ", momentum by ", brief(momentum_off));
  CHECK(energy_off < 1e-13);
  CHECK(momentum_off < 1e-13);
}

TEST_CASE("Coincidences: one particle hits two that touch, at once" *
          doctest::description("the same bits by brute force; energy and momentum within "
                               "1e-15, inelastic ones lose energy")) {
  double energy_off = 0.0, momentum_off = 0.0;
  for (const double restitution : {1.0, 0.9, 0.0}) {
    for (const double height : {0.0, 1e-16, 1e-9}) {
      CAPTURE(restitution);
      CAPTURE(height);
      const Model<2> model = inelastic(periodic_box(40.0, 40.0), restitution);
      // Both are at a distance of 1 from (20, 20) when the first arrives there.
      const double up = 0.5, along = 0.5 * std::sqrt(3.0);
      const State<2> start{
          {{17.0, 20.0 + height}, {20.0 + along, 20.0 - up}, {20.0 + along, 20.0 + up}},
          {{1.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}};
      Simulation<2> simulation(model, start);
      simulation.run_until(4.0);
      const State<2> end = simulation.state();
      CHECK(simulation.counts().pair_collisions >= 2);
      CHECK(finite_and_inside(model, end));
      check_sound(simulation);
      compare_by_brute_force(model, start, simulation.counts().pair_collisions);
      momentum_off = std::max(momentum_off, (momentum(end) - momentum(start)).norm());
      if (restitution == 1.0) {
        energy_off = std::max(energy_off, std::fabs(energy_of(end) / energy_of(start) - 1.0));
      } else {
        CHECK(energy_of(end) < energy_of(start));
      }
    }
  }
  MESSAGE("energy off by ", brief(energy_off), ", momentum by ", brief(momentum_off));
  CHECK(energy_off <= 1e-15);
  CHECK(momentum_off <= 1e-15);
}

TEST_CASE(
    "Coincidences: a row of inelastic particles in contact is hit" *
    doctest::description("it ends or is told to collapse; momentum within 1e-14, overlap below "
                         "1e-12")) {
  double momentum_off = 0.0, deepest = 0.0;
  int stops = 0;
  for (const double restitution : {0.999, 0.9, 0.5, 0.1, 0.0}) {
    const Model<2> model = inelastic(periodic_box(60.0, 6.0), restitution);
    State<2> start;
    for (int i = 0; i < 11; ++i) {
      start.positions.push_back({i == 0 ? 2.0 : 4.0 + i, 3.0});
      start.velocities.push_back({i == 0 ? 1.0 : 0.0, 0.0});
    }
    Simulation<2> simulation(model, start);
    stops += !stop_of(simulation, 1000.0).empty();
    const State<2> end = simulation.state();
    CHECK(finite_and_inside(model, end));
    momentum_off = std::max(momentum_off, (momentum(end) - momentum(start)).norm());
    deepest = std::max(deepest, simulation.checks().deepest_overlap);
  }
  MESSAGE(stops, " of 5 collapse; momentum off by ", brief(momentum_off), ", deepest overlap ",
          brief(deepest));
  CHECK(momentum_off < 1e-14);
  CHECK(deepest < 1e-12);
}

TEST_CASE("Coincidences: a particle flies into a corner" *
          doctest::description(
              "it comes back on its way, speed and place exact; so does a particle whose "
              "way through the corner two walls share with another particle")) {
  const Model<2> model = four(kStatic, kStatic);  // 9 x 8
  // Along the diagonal into the corner at (0, 0), with exact numbers.
  Simulation<2> alone(model, State<2>{{{2.5, 2.5}}, {{-1.0, -1.0}}});
  alone.run_until(4.0);
  CHECK(alone.counts().wall_collisions == 2);
  CHECK(alone.state().positions[0] == Vec2(2.5, 2.5));
  CHECK(alone.state().velocities[0] == Vec2(1.0, 1.0));
  // One rests in the corner. Two others arrive at the same time, along the floor and along the
  // wall.
  const State<2> crowd{{{0.5, 0.5}, {3.5, 0.5}, {0.5, 3.5}},
                       {{0.0, 0.0}, {-1.0, 0.0}, {0.0, -1.0}}};
  Simulation<2> three(model, crowd);
  three.run_until(6.0);
  CHECK(three.state().positions[1] == Vec2(5.5, 0.5));
  CHECK(three.state().positions[2] == Vec2(0.5, 5.5));
  CHECK(three.kinetic_energy() == 1.0);
  compare_by_brute_force(model, crowd, three.counts().collisions());
  // From many positions into every corner. Rounding decides which wall comes first.
  double energy_off = 0.0, deepest = 0.0;
  for (int k = 0; k < 64; ++k) {
    const Vec2 corner(k % 2 ? 8.5 : 0.5, k % 4 < 2 ? 7.5 : 0.5);
    const Vec2 from(2.0 + 0.07 * k, 6.0 - 0.05 * k);
    Simulation<2> simulation(model, State<2>{{from}, {corner - from}});
    const double energy = simulation.kinetic_energy();
    simulation.run_until(1.5);
    CHECK(simulation.counts().wall_collisions == 2);
    CHECK(simulation.state().velocities[0] == from - corner);
    energy_off = std::max(energy_off, std::fabs(simulation.kinetic_energy() / energy - 1.0));
    deepest = std::max(deepest, simulation.checks().deepest_overlap);
  }
  MESSAGE("energy off by ", brief(energy_off), ", deepest overlap ", brief(deepest));
  CHECK(energy_off == 0.0);
  CHECK(deepest < 1e-14);
}
