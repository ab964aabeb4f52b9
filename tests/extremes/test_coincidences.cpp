#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/dynamics/simulation.h"
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
template <int D>
void compare_by_brute_force(const Model<D>& model, const State<D>& start,
                            std::uint64_t collisions) {
  Simulation<D> simulation(model, start);
  run_beside_reference(simulation, start, collisions);
  CHECK(simulation.counts().collisions() == collisions);
  check_sound(simulation);
}

template <int D>
double energy_of(const State<D>& state) {
  double twice = 0.0;
  for (const Vec<D>& v : state.velocities) twice += v.squaredNorm();
  return 0.5 * twice;
}

template <int D>
void check_lattice(const Model<D>& model, const State<D>& start) {
  constexpr std::uint64_t kCollisions = D == 2 ? 2000 : 1000;
  compare_by_brute_force(model, start, kCollisions);
  Simulation<D> simulation(model, start);
  simulation.run_until(kNever, kCollisions);
  const State<D> end = simulation.state();
  const double energy_off = std::fabs(energy_of(end) / energy_of(start) - 1.0);
  const double momentum_off = (momentum(end) - momentum(start)).norm() / start.positions.size();
  MESSAGE("energy off by ", brief(energy_off), ", momentum by ", brief(momentum_off));
  CHECK(energy_off < 1e-13);
  CHECK(momentum_off < 1e-13);
}

// The first particle arrives at the place from which all others are one diameter away, along x. The
// others touch each other.
template <int D>
void check_simultaneous_hits(const std::vector<Vec<D>>& others) {
  double energy_off = 0.0, momentum_off = 0.0;
  for (const double restitution : {1.0, 0.9, 0.0}) {
    for (const double height : {0.0, 1e-16, 1e-9}) {
      CAPTURE(restitution);
      CAPTURE(height);
      const Model<D> model = inelastic(periodic_box<D>(Vec<D>::Constant(40.0)), restitution);
      const Vec<D> middle = Vec<D>::Constant(20.0);
      State<D> start{{middle - 3.0 * Vec<D>::UnitX() + height * Vec<D>::UnitY()},
                     {Vec<D>::UnitX()}};
      for (const Vec<D>& other : others) {
        start.positions.push_back(middle + other);
        start.velocities.push_back(Vec<D>::Zero());
      }
      Simulation<D> simulation(model, start);
      simulation.run_until(4.0);
      const State<D> end = simulation.state();
      CHECK(simulation.counts().pair_collisions >= others.size());
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

// A box of 9 x 8 (x 7) between elastic walls. Every number of the first two flights is exact.
template <int D>
void check_corners() {
  const Vec<D> box = Vec<3>(9.0, 8.0, 7.0).head<D>();
  const Model<D> model = walled(periodic_box<D>(box), kStatic);
  // Along the diagonal into the corner at the origin.
  const Vec<D> place = Vec<D>::Constant(2.5);
  Simulation<D> alone(model, State<D>{{place}, {-Vec<D>::Ones()}});
  alone.run_until(4.0);
  CHECK(alone.counts().wall_collisions == D);
  CHECK(alone.state().positions[0] == place);
  CHECK(alone.state().velocities[0] == Vec<D>::Ones());
  // One rests in the corner. Others arrive at the same time, along each edge.
  State<D> crowd{{Vec<D>::Constant(0.5)}, {Vec<D>::Zero()}};
  for (int axis = 0; axis < D; ++axis) {
    crowd.positions.push_back(Vec<D>::Constant(0.5) + 3.0 * Vec<D>::Unit(axis));
    crowd.velocities.push_back(-Vec<D>::Unit(axis));
  }
  Simulation<D> all(model, crowd);
  all.run_until(6.0);
  for (int axis = 0; axis < D; ++axis) {
    CHECK(all.state().positions[static_cast<std::size_t>(axis) + 1] ==
          Vec<D>::Constant(0.5) + 5.0 * Vec<D>::Unit(axis));
  }
  CHECK(all.kinetic_energy() == 0.5 * D);
  compare_by_brute_force(model, crowd, all.counts().collisions());
  // From many positions into every corner. Rounding decides which wall comes first.
  double energy_off = 0.0, deepest = 0.0;
  for (int k = 0; k < 64; ++k) {
    Vec<D> corner;
    for (int axis = 0; axis < D; ++axis) {
      corner[axis] = k >> axis & 1 ? box[axis] - 0.5 : 0.5;
    }
    const Vec<D> from = Vec<3>(2.0 + 0.07 * k, 6.0 - 0.05 * k, 1.5 + 0.061 * k).head<D>();
    Simulation<D> simulation(model, State<D>{{from}, {corner - from}});
    const double energy = simulation.kinetic_energy();
    simulation.run_until(1.5);
    CHECK(simulation.counts().wall_collisions == D);
    CHECK(simulation.state().velocities[0] == from - corner);
    energy_off = std::max(energy_off, std::fabs(simulation.kinetic_energy() / energy - 1.0));
    deepest = std::max(deepest, simulation.checks().deepest_overlap);
  }
  MESSAGE("energy off by ", brief(energy_off), ", deepest overlap ", brief(deepest));
  CHECK(energy_off == 0.0);
  CHECK(deepest < 1e-14);
}

}  // namespace

TEST_CASE("Coincidences: a lattice with simultaneous collisions in all rows and columns" *
          doctest::description("the same bits as brute force; energy and momentum within 1e-13")) {
  // Neighbours approach along x, or rest: 32 collisions at each of the first times.
  State<2> start;
  for (int i = 0; i < 48; ++i) {
    const int column = i % 8, row = i / 8;
    start.positions.push_back({1.0 + 2.0 * column, 1.0 + 2.0 * row});
    start.velocities.push_back({column % 2 ? -1.0 : 1.0, row % 3 == 2 ? 0.5 : -0.25});
  }
  check_lattice(periodic_box(16.0, 12.0), start);
}

TEST_CASE("Coincidences: a cubic lattice with simultaneous collisions in all rows" *
          doctest::description("the same bits as brute force; energy and momentum within 1e-13")) {
  State<3> start;
  for (int i = 0; i < 48; ++i) {
    const int column = i % 4, row = i / 4 % 4, layer = i / 16;
    start.positions.push_back({1.0 + 2.0 * column, 1.0 + 2.0 * row, 1.0 + 2.0 * layer});
    start.velocities.push_back(
        {column % 2 ? -1.0 : 1.0, row % 3 == 2 ? 0.5 : -0.25, layer == 1 ? 0.5 : 0.0});
  }
  check_lattice(periodic_box(8.0, 8.0, 6.0), start);
}

TEST_CASE("Coincidences: one particle hits two touching particles at the same time" *
          doctest::description("the same bits as brute force; energy and momentum within 1e-15; "
                               "inelastic particles lose energy")) {
  const double along = 0.5 * std::sqrt(3.0);
  check_simultaneous_hits<2>({{along, -0.5}, {along, 0.5}});
}

TEST_CASE("Coincidences: one sphere hits three touching spheres at the same time" *
          doctest::description("the same bits as brute force; energy and momentum within 1e-15; "
                               "inelastic particles lose energy")) {
  // A regular tetrahedron.
  const double along = std::sqrt(2.0 / 3.0), across = 1.0 / std::sqrt(3.0);
  check_simultaneous_hits<3>(
      {{along, across, 0.0}, {along, -0.5 * across, 0.5}, {along, -0.5 * across, -0.5}});
}

TEST_CASE("Coincidences: a particle hits a row of touching inelastic particles" *
          doctest::description("the run ends, or stops with an inelastic collapse; momentum within "
                               "1e-14, overlap below 1e-12")) {
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

TEST_CASE("Coincidences: a particle hits a corner" *
          doctest::description("it returns on its path with exact speed and position; so do two "
                               "particles that reach an occupied corner at the same time")) {
  check_corners<2>();
}

TEST_CASE("Coincidences: a sphere hits a corner of three walls" *
          doctest::description("it returns on its path with exact speed and position; so do three "
                               "spheres that reach an occupied corner at the same time")) {
  check_corners<3>();
}
