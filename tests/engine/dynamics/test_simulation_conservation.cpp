#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

// N = 1000 at phi = .5. Energy and momentum are of order 1000. The rounding error of each collision
// is some 1e-16, of either sign.
TEST_CASE("Conservation: 10^6 elastic collisions keep energy and momentum") {
  constexpr int kCount = 1000;
  constexpr std::uint64_t kCollisions = 1000000;
  const double edge = std::sqrt(kCount * std::numbers::pi / (4.0 * 0.5));
  const Model<2> model = periodic_box(edge, edge);
  const State<2> start = random_gas(model, kCount, 91);
  Simulation<2> simulation(model, start);
  const double energy = simulation.kinetic_energy();
  simulation.run_until(kNever, kCollisions);
  CHECK(simulation.counts().pair_collisions == kCollisions);
  CHECK(std::fabs(simulation.kinetic_energy() / energy - 1.0) < 1e-12);
  CHECK((momentum(simulation.state()) - momentum(start)).norm() / kCount < 1e-12);
  CHECK(simulation.checks().deepest_overlap < 1e-12);
  CHECK(simulation.checks().clock_steps_back == 0.0);
  CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
}

// An inelastic collision dissipates (1/4)(1 - alpha^2) g_n^2 (theory 3.6). The energy balance must
// close.
TEST_CASE("Conservation: collisions take the energy that the gas loses") {
  class Ledger : public Observer<2> {
   public:
    double taken = 0.0;
    double booked = 0.0;
    void on_collision(const PairCollision<2>& c) override {
      const double g_n =
          c.separation.dot(c.particles[0].velocity - c.particles[1].velocity) / c.separation.norm();
      taken += 0.25 * (1.0 - 0.9 * 0.9) * g_n * g_n;
      booked += c.particles[0].energy() + c.particles[1].energy();
    }
  } ledger;
  Model<2> model = periodic_box(20.0, 15.0);
  model.restitution = 0.9;
  Simulation<2> simulation(model, random_gas(model, 100, 92));
  simulation.add_observer(ledger);
  const double before = simulation.kinetic_energy();
  simulation.run_until(kNever, 5000);
  const double after = simulation.kinetic_energy();
  CHECK(after < 0.2 * before);
  CHECK(std::fabs((before - ledger.taken) - after) < 1e-12 * before);
  CHECK(std::fabs((before + ledger.booked) - after) < 1e-12 * before);
  check_sound(simulation);
}

// After a missed collision two particles pass through each other, in a time of order 1. A test
// every .1 finds them.
TEST_CASE("Conservation: particles never overlap, by brute force over all images") {
  const Model<2> models[] = {
      periodic_box(14.0, 13.0), with_walls(periodic_box(14.0, 13.0), 0, kDriven),
      with_walls(with_walls(periodic_box(14.0, 13.0), 0, kDriven), 1, kThermal),
      periodic_box(90.0, 2.05), periodic_box(150.0, 1.2)};
  for (Model<2> model : models) {
    CAPTURE(model.box);
    model.restitution = 0.95;
    Simulation<2> simulation(model, random_gas(model, 100, 93));
    double deepest = 0.0;
    for (int i = 1; i <= 1000; ++i) {
      simulation.run_until(0.1 * i);
      const State<2> state = simulation.state();
      deepest = std::max(deepest, brute_force_overlap(model, state));
      REQUIRE(finite_and_inside(model, state));
    }
    CHECK(deepest < 1e-12);
    CHECK(simulation.counts().pair_collisions > 2000);
    check_sound(simulation);
  }
}
