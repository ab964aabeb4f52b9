#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

// The ends of the ranges of friction and restitution.

namespace {

double energy(const Simulation<2>& simulation) {
  return simulation.kinetic_energy() + simulation.spin_energy();
}

State<2> without_spins(State<2> state) {
  state.spins.clear();
  return state;
}

}  // namespace

TEST_CASE("Laws: beta = -1, and mu = 0, with spins" *
          doctest::description("positions and velocities have the same bits as with smooth "
                               "particles, spins do not change")) {
  const Model<2> smooth = inelastic(four(kDriven, kLossy), 0.9);
  std::uint64_t collisions = 0;
  for (const Roughness& roughness : {Roughness{kInfinity, -1.0}, Roughness{0.3, -1.0},
                                     Roughness{0.0, 0.7}, Roughness{0.0, 1.0}}) {
    Model<2> model = smooth;
    model.spins = true;
    model.roughness = roughness;
    for (auto& wall : model.walls) wall->roughness = roughness;
    const State<2> start = clear_gas(model, 30, 952);
    Simulation<2> turning(model, start), plain(smooth, without_spins(start));
    turning.run_until(kNever, 20000);
    plain.run_until(kNever, 20000);
    CHECK(state_hash<2>(without_spins(turning.state())) == plain.state_hash());
    CHECK(turning.state().spins == start.spins);
    collisions += turning.counts().collisions();
  }
  MESSAGE(collisions, " collisions, the same bits");
}

TEST_CASE("Laws: beta = +1 with alpha = 1" *
          doctest::description("energy of translation and rotation conserved to 1e-12")) {
  double worst = 0.0;
  for (const bool walled : {false, true}) {
    Model<2> model = rough(periodic_box(14.0, 13.0), kInfinity, 1.0);
    const Wall wall{.roughness = {kInfinity, 1.0}};
    if (walled) model = with_walls(with_walls(model, 0, wall), 1, wall);
    Simulation<2> simulation(model, clear_gas(model, 80, 953));
    const double before = energy(simulation);
    simulation.run_until(kNever, 100000);
    worst = std::max(worst, std::fabs(energy(simulation) / before - 1.0));
    check_sound(simulation);
  }
  MESSAGE("off by ", brief(worst));
  CHECK(worst < 1e-12);
}

TEST_CASE("Laws: beta = 0, and mu = inf, with alpha = 1" *
          doctest::description("energy never rises; mu = 1e300 gives the same bits as mu = inf")) {
  const auto gas_of = [](double friction) { return rough(four(kStatic, kStatic), friction, 0.0); };
  const State<2> start = clear_gas(gas_of(kInfinity), 30, 954);
  Simulation<2> unlimited(gas_of(kInfinity), start), huge(gas_of(1e300), start);
  double before = energy(unlimited);
  for (std::uint64_t k = 1; k <= 50; ++k) {
    unlimited.run_until(kNever, 100 * k);
    CHECK(energy(unlimited) < before);
    before = energy(unlimited);
  }
  huge.run_until(kNever, 5000);
  CHECK(unlimited.state_hash() == huge.state_hash());
  MESSAGE("energy ", brief(before), " after 5000 collisions");
  check_sound(unlimited);
}

TEST_CASE("Laws: alpha_w = 0" *
          doctest::description(
              "particles leave these walls with v_dr, or slide along them; overlap below 1e-12")) {
  double deepest = 0.0;
  for (const double drive : {0.0, 1.0}) {
    const Wall wall{.kind = WallKind::Driven, .restitution = 0.0, .drive_speed = drive};
    const Model<2> model = inelastic(with_walls(periodic_box(20.0, 15.0), 0, wall), 0.95);
    Simulation<2> simulation(model, random_gas(model, 60, 955));
    const std::string stop = stop_of(simulation, 200.0);
    CHECK_MESSAGE(stop.empty(), stop);
    CHECK(finite_and_inside(model, simulation.state()));
    deepest = std::max({deepest, simulation.checks().deepest_overlap,
                        brute_force_overlap(model, simulation.state())});
    if (drive > 0.0) CHECK(simulation.kinetic_energy() > 1.0);
  }
  MESSAGE("deepest overlap ", brief(deepest));
  CHECK(deepest < 1e-12);
}
