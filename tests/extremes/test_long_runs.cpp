#include <doctest/doctest.h>

#include <cmath>

#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

// Conserved quantities after very many events. Cases that take minutes need --no-skip.

namespace {

// Momentum from walls, and the sum of its magnitudes.
class WallMomentum : public Observer<2> {
 public:
  Vec2 given = Vec2::Zero();
  double size = 0.0;
  void on_wall(const WallCollision<2>& c) override {
    given += c.particle.gain.momentum;
    size += c.particle.gain.momentum.norm();
  }
};

// 100 elastic particles at phi = .31 between walls along x, periodic along y.
void conserve(std::uint64_t events) {
  const Model<2> model = with_walls(periodic_box(16.0, 16.0), 0, kStatic);
  State<2> start = random_gas(model, 100, 923);
  const Vec2 drift = momentum(start) / 100.0;
  for (Vec2& v : start.velocities) v -= drift;
  Simulation<2> simulation(model, start);
  WallMomentum walls;
  simulation.add_observer(walls);
  const double energy = simulation.kinetic_energy();
  simulation.run_until(kNever, events);
  const Vec2 gained = momentum(simulation.state()) - momentum(start);
  const double energy_off = std::fabs(simulation.kinetic_energy() / energy - 1.0);
  // Relative to the sum of all particles' speeds, of order N.
  const double momentum_off = std::fabs(gained.y()) / 100.0;
  const double ledger_off = std::fabs(gained.x() - walls.given.x()) / walls.size;
  MESSAGE(brief(static_cast<double>(events)), " events, t = ", brief(simulation.time()),
          ": energy off by ", brief(energy_off), ", momentum by ", brief(momentum_off),
          ", wall ledger by ", brief(ledger_off), ", overlap ",
          brief(simulation.checks().deepest_overlap));
  CHECK(energy_off <= 1e-10);
  CHECK(momentum_off <= 1e-10);
  CHECK(ledger_off <= 1e-10);
  check_sound(simulation);
}

// Energy of motion and spin from each type of event.
class Ledger : public Observer<2> {
 public:
  double particles = 0.0, walls = 0.0, kicks = 0.0;
  void on_collision(const PairCollision<2>& c) override {
    particles += c.particles[0].energy + c.particles[1].energy;
  }
  void on_wall(const WallCollision<2>& c) override { walls += c.particle.energy; }
  void on_kick(const Kick<2>& k) override { kicks += k.particle.energy; }
};

// 100 inelastic particles between driven walls, kicked as well.
void balance(std::uint64_t events) {
  Model<2> model = inelastic(with_walls(periodic_box(20.0, 25.0), 0, kDriven), 0.9);
  model.bulk_drive = BulkDrive{0.5, 0.2, 0.0};
  Simulation<2> simulation(model, random_gas(model, 100, 924));
  Ledger ledger;
  simulation.add_observer(ledger);
  const double before = simulation.kinetic_energy();
  simulation.run_until(kNever, events);
  const double left = simulation.kinetic_energy() - before;
  const double off =
      std::fabs(left - (ledger.walls + ledger.kicks + ledger.particles)) / -ledger.particles;
  MESSAGE(brief(static_cast<double>(events)), " events, t = ", brief(simulation.time()),
          ": walls gave ", brief(ledger.walls), ", kicks ", brief(ledger.kicks),
          ", collisions took ", brief(-ledger.particles), "; the rest is off by ", brief(off));
  CHECK(ledger.kicks > 0.01 * -ledger.particles);
  CHECK(off <= 1e-10);
  check_sound(simulation);
}

}  // namespace

TEST_CASE("Long runs: elastic, 10^7 events" * doctest::test_suite("slow") *
          doctest::description("energy 1e-10, momentum 1e-10, wall momentum ledger 1e-10")) {
  conserve(10'000'000);
}

TEST_CASE("Long runs: elastic, 10^9 events" * doctest::skip() *
          doctest::description("energy 1e-10, momentum 1e-10, wall momentum ledger 1e-10")) {
  conserve(1'000'000'000);
}

TEST_CASE("Long runs: driven, 10^7 events" * doctest::test_suite("slow") *
          doctest::description("ledger per type of event closes to 1e-10 of the dissipated")) {
  balance(10'000'000);
}

TEST_CASE("Long runs: driven, 10^8 events" * doctest::skip() *
          doctest::description("ledger per type of event closes to 1e-10 of the dissipated")) {
  balance(100'000'000);
}
