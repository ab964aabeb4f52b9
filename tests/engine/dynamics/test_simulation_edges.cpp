#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("Simulation: wholly inelastic particles collide once and move on together") {
  int collisions = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Model<2> model = periodic_box(9.0, 8.0);
    model.restitution = 0.0;
    Simulation<2> simulation(model, random_gas(model, 2, seed));
    simulation.run_until(1000.0);
    // Without tangential losses a pair may meet again through a periodic image.
    collisions += static_cast<int>(simulation.counts().pair_collisions);
    REQUIRE(simulation.counts().pair_collisions < 1000);
    REQUIRE(finite_and_inside(model, simulation.state()));
    check_sound(simulation);
  }
  CHECK(collisions > 200);
}

namespace {

/// The overlap of particles at contact, relative to the longest flight that ended there.
template <int D>
class OverlapOfFlights : public Observer<D> {
 public:
  double longest = 0.0, deepest = 0.0;

  void on_collision(const PairCollision<D>& c) override {
    double length = 1.0;
    for (const ParticleChange<D>& particle : c.particles) {
      length = std::max(length, (c.time - particle.before.time) * particle.before.v.norm());
    }
    longest = std::max(longest, length);
    deepest = std::max(deepest, (1.0 - c.separation.norm()) / length);
  }
};

// Dissipative walls slow two particles along x, which drift along the periodic axes. At the end
// they cross the box thousands of times between contacts. A position has a relative rounding error
// of 2^-52 of the flight length, and so does the distance of two particles.
template <int D>
void check_long_flights(const Model<D>& box) {
  const Model<D> model = with_walls(box, 0, kLossy);
  Simulation<D> simulation(model, clear_gas(model, 2, 83));
  OverlapOfFlights<D> overlaps;
  simulation.add_observer(overlaps);
  simulation.run_until(kNever, 300);
  CHECK(overlaps.longest > 5e3);
  CHECK(overlaps.deepest < 4e-15);
}

}  // namespace

TEST_CASE("Simulation: contacts after long flights are as exact as these are long") {
  check_long_flights(periodic_box(2.6, 2.3));
  check_long_flights(periodic_box(2.6, 2.3, 2.1));
}

// A disk between two walls with a clearance of 1e-11 diameters. Positions along x have rounding
// errors of 1e-10, so that each flight is a tenth of the rounding error.
TEST_CASE("Simulation: short flights add up where positions are coarse") {
  const double x = 999900.0, speed = 0.003;
  const Model<2> model = with_walls(periodic_box(1e6, 1.0 + 0x1p-36), 1, Wall{});
  Simulation<2> simulation(model, {{{x, 0.5}}, {{speed, 0.0024}}});
  simulation.run_until(1.0, 100'000);
  CHECK(simulation.counts().wall_collisions == 100'000);
  const double time = simulation.time();
  CHECK(time == doctest::Approx(100'000 * 0x1p-36 / 0.0024).epsilon(1e-4));
  const double coarse = std::nextafter(x, 2.0 * x) - x;
  CHECK(std::fabs(simulation.state().positions[0].x() - (x + speed * time)) <= coarse);

  // A resumed run continues with the same remainders.
  Simulation<2> resumed(model, simulation.save());
  simulation.run_until(1.0, 200'000);
  resumed.run_until(1.0, 200'000);
  CHECK(resumed.save().remainders == simulation.save().remainders);
}

TEST_CASE("Simulation: a start with overlap is refused, one that touches is not") {
  const Model<2> model = with_walls(periodic_box(9.0, 8.0), 0, Wall{});
  const auto start = [](Vec2 a, Vec2 b) { return State<2>{{a, b}, {Vec2::Zero(), Vec2::Zero()}}; };
  CHECK_NOTHROW(Simulation<2>(model, start({2.0, 3.0}, {3.0, 3.0})));
  CHECK_NOTHROW(Simulation<2>(model, start({0.5, 3.0}, {8.5, 3.0})));
  CHECK_THROWS_AS(Simulation<2>(model, start({2.0, 3.0}, {2.999, 3.0})), PhysicalStop);
  CHECK_THROWS_AS(Simulation<2>(model, start({2.0, 0.2}, {2.0, 7.5})), PhysicalStop);
  CHECK_THROWS_AS(Simulation<2>(model, start({0.4, 3.0}, {5.0, 3.0})), PhysicalStop);
  CHECK_THROWS_AS(Simulation<2>(model, start({2.0, 3.0}, {8.6, 3.0})), PhysicalStop);
  for (const double far : {-1e300, -9.5, 18.5, 1e14}) {
    CHECK_THROWS_WITH_AS(Simulation<2>(model, start({2.0, 3.0}, {far, 3.0})),
                         "particle 1 is outside of the box at the start", PhysicalStop);
  }
}

// An elastic particle, dropped from rest at a cell border, turns there repeatedly, above or below
// it by rounding errors. At this late time it may cross twice at one time.
// A damaged checkpoint may have this position. Numbers of periodic images are less than 2^30.
TEST_CASE("Simulation: a position too many periodic images away is refused") {
  const Model<2> model = periodic_box(9.0, 8.0);
  for (const double x : {-5e14, -1e10, 1e10, 5e14}) {
    CAPTURE(x);
    CHECK_THROWS_WITH_AS(Simulation<2>(model, {{{2.0, 2.0}, {x, 5.0}}, {{0.0, 0.0}, {1.0, 0.0}}}),
                         "particle 1 is outside of the box at the start", PhysicalStop);
  }
  CHECK_NOTHROW(Simulation<2>(model, {{{2.0, 2.0}, {9e9, 5.0}}, {{0.0, 0.0}, {1.0, 0.0}}}));
}

TEST_CASE("Simulation: a particle may turn round on a border of its cell") {
  for (const double height : {1.5, 2.0, 3.0, 4.0, 5.25}) {
    Model<2> model = with_walls(periodic_box(8.0, 8.0), 1, Wall{});
    model.gravity = {0.0, -1.0};
    State<2> start;
    start.positions = {{2.0, height}, {6.0, 0.5 + (height - 0.5) / 4.0}};
    start.velocities = {{0.0, 0.0}, {0.0, 0.0}};
    Simulation<2> simulation(model, start);
    simulation.run_until(20000.0);
    CHECK(simulation.counts().wall_collisions > 5000);
    CHECK(simulation.kinetic_energy() <= height);
    check_sound(simulation);
  }
}

// As above, with cells too narrow for an overhang, as around a crystal in a wide box
// (CellGrid::fit). All particles are on borders, rise, and return within the smallest time
// step.
TEST_CASE("Simulation: particles may turn round just beyond a border of narrow cells") {
  Model<2> model = periodic_box(20.2, 20.2);
  model.gravity = {0.0, -1e4};
  RunState<2> saved;
  saved.gravity = model.gravity;
  saved.now = 1e4;
  for (int i = 0; i < 100; ++i) {
    const Vec2 place(1.01 * (2 + i % 10), 1.01 * (2 + i / 10));
    saved.flights.push_back({place, {0.0, 1e-10 * (i % 10)}, saved.now, 0});
  }
  saved.until_base_moves = 1000;
  Simulation<2> simulation(model, saved);
  CHECK(simulation.run_until(1e4 + 1e-9, kNoLimit, 1000));
  CHECK(simulation.counts().cell_crossings >= 90);
  CHECK(simulation.deepest_overlap() == 0.0);
}
