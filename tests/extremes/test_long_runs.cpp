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
template <int D>
class WallMomentum : public Observer<D> {
 public:
  Vec<D> given = Vec<D>::Zero();
  double size = 0.0;
  void on_wall(const WallCollision<D>& c) override {
    given += c.particle.gain.momentum;
    size += c.particle.gain.momentum.norm();
  }
};

// The energy of disks drifts by rounding, in proportion to the events: .8e-19 of it per event. That
// of spheres has a random walk only, see contact_square.
template <int D>
constexpr double kMaxDrift = D == 2 ? 1e-10 : 1e-12;

// 100 elastic particles between walls along x, periodic along the other axes.
template <int D>
void conserve(const Model<D>& box, std::uint64_t events) {
  const Model<D> model = with_walls(box, 0, kStatic);
  State<D> start = random_gas(model, 100, 923);
  const Vec<D> drift = momentum(start) / 100.0;
  for (Vec<D>& v : start.velocities) v -= drift;
  Simulation<D> simulation(model, start);
  WallMomentum<D> walls;
  simulation.add_observer(walls);
  const double energy = simulation.kinetic_energy();
  simulation.run_until(kNever, events);
  const Vec<D> gained = momentum(simulation.state()) - momentum(start);
  const double energy_off = std::fabs(simulation.kinetic_energy() / energy - 1.0);
  // Relative to the sum of all particles' speeds, of order N.
  const double momentum_off = gained.template tail<D - 1>().norm() / 100.0;
  const double ledger_off = std::fabs(gained.x() - walls.given.x()) / walls.size;
  MESSAGE(brief(static_cast<double>(events)), " events, t = ", brief(simulation.time()),
          ": energy off by ", brief(energy_off), ", momentum by ", brief(momentum_off),
          ", wall impulses by ", brief(ledger_off), ", overlap ",
          brief(simulation.checks().deepest_overlap));
  CHECK(energy_off <= kMaxDrift<D>);
  CHECK(momentum_off <= 1e-10);
  CHECK(ledger_off <= 1e-10);
  CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
  check_sound(simulation);
}

// Energy of motion and spin from each type of event.
template <int D>
class Ledger : public Observer<D> {
 public:
  double particles = 0.0, walls = 0.0, kicks = 0.0;
  void on_collision(const PairCollision<D>& c) override {
    particles += c.particles[0].energy() + c.particles[1].energy();
  }
  void on_wall(const WallCollision<D>& c) override { walls += c.particle.energy(); }
  void on_kick(const Kick<D>& k) override { kicks += k.particle.energy(); }
};

// 100 inelastic particles between driven walls, kicked as well.
template <int D>
void balance(const Model<D>& box, std::uint64_t events) {
  Model<D> model = inelastic(with_walls(box, 0, kDriven), 0.9);
  model.bulk_drive = BulkDrive{0.5, 0.2, 0.0};
  Simulation<D> simulation(model, random_gas(model, 100, 924));
  Ledger<D> ledger;
  simulation.add_observer(ledger);
  const double before = simulation.kinetic_energy();
  simulation.run_until(kNever, events);
  const double left = simulation.kinetic_energy() - before;
  const double off =
      std::fabs(left - (ledger.walls + ledger.kicks + ledger.particles)) / -ledger.particles;
  MESSAGE(brief(static_cast<double>(events)), " events, t = ", brief(simulation.time()),
          ": energy from walls ", brief(ledger.walls), ", from kicks ", brief(ledger.kicks),
          ", lost in collisions ", brief(-ledger.particles), "; balance off by ", brief(off));
  CHECK(ledger.kicks > 0.01 * -ledger.particles);
  CHECK(off <= 1e-10);
  check_sound(simulation);
}

// phi = .31 elastic, .16 driven.
const Model<2> kDisks = periodic_box(16.0, 16.0), kWideDisks = periodic_box(20.0, 25.0);
// phi = .29 elastic, .10 driven.
const Model<3> kSpheres = periodic_box(6.0, 5.5, 5.5), kWideSpheres = periodic_box(10.0, 7.0, 7.5);

}  // namespace

TEST_CASE("Long runs: elastic, 10^7 events" * doctest::test_suite("slow") *
          doctest::description("energy and momentum along periodic axes conserved to 1e-10; "
                               "momentum along x equals the wall impulses to 1e-10")) {
  conserve<2>(kDisks, 10'000'000);
}

TEST_CASE("Long runs: elastic, 10^9 events" * doctest::skip() *
          doctest::description("energy and momentum along periodic axes conserved to 1e-10; "
                               "momentum along x equals the wall impulses to 1e-10")) {
  conserve<2>(kDisks, 1'000'000'000);
}

TEST_CASE("Long runs: elastic spheres, 10^7 events" * doctest::test_suite("slow") *
          doctest::description("energy conserved to 1e-12, momentum along periodic axes to 1e-10; "
                               "momentum along x equals the wall impulses to 1e-10")) {
  conserve<3>(kSpheres, 10'000'000);
}

TEST_CASE("Long runs: elastic spheres, 10^9 events" * doctest::skip() *
          doctest::description("energy conserved to 1e-12, momentum along periodic axes to 1e-10; "
                               "momentum along x equals the wall impulses to 1e-10")) {
  conserve<3>(kSpheres, 1'000'000'000);
}

TEST_CASE("Long runs: driven, 10^7 events" * doctest::test_suite("slow") *
          doctest::description("energy gains and losses of all events add up to the change of "
                               "energy within 1e-10 of the loss")) {
  balance<2>(kWideDisks, 10'000'000);
}

TEST_CASE("Long runs: driven, 10^8 events" * doctest::skip() *
          doctest::description("energy gains and losses of all events add up to the change of "
                               "energy within 1e-10 of the loss")) {
  balance<2>(kWideDisks, 100'000'000);
}

TEST_CASE("Long runs: driven spheres, 10^7 events" * doctest::test_suite("slow") *
          doctest::description("energy gains and losses of all events add up to the change of "
                               "energy within 1e-10 of the loss")) {
  balance<3>(kWideSpheres, 10'000'000);
}
