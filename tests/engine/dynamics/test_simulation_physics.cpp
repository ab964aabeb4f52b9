#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/measure/totals.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"

using namespace clatter;
using namespace clatter::testing;

// Every feature of the model, alone and combined, compared with the brute-force reference.

namespace {

// The state after this number of collisions must equal the reference to the last bit.
void compare(const std::string& name, const Model<2>& model, const std::vector<int>& counts,
             std::uint64_t collisions = 1000) {
  for (const int count : counts) {
    CAPTURE(name);
    CAPTURE(count);
    const State<2> start = clear_gas(model, count, 83);
    Simulation<2> simulation(model, start);
    Totals<2> totals(simulation);
    simulation.add_observer(totals);
    const BaseMoves<2> moves(simulation);
    Reference<2> reference(model, start, moves);
    simulation.run_until(kNever, collisions);
    reference.run_until_collisions(collisions);
    CHECK(simulation.counts().pair_collisions == reference.collisions());
    CHECK(simulation.counts().wall_collisions == reference.wall_hits());
    CHECK(simulation.counts().kicks == reference.kicks());
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    CHECK(simulation.deepest_overlap() < 1e-12);
    CHECK(totals.ledger_residual() < 1e-12);
    CHECK(simulation.checks().clock_steps_back < 1e-13);
    // Two particles may fly a thousand box lengths before they meet, with a thousand times the
    // rounding error.
    CHECK(simulation.checks().deepest_overlap < 1e-11);
  }
}

}  // namespace

TEST_CASE("Reference: rough particles and rough walls give the same bits") {
  const Model<2> periodic = inelastic(periodic_box(9.0, 8.0), 0.9);
  // A short run: velocities in a gas that cools finally differ by rounding errors only.
  compare("constant beta", rough(periodic, kInfinity, 0.4), {3, 12, 30}, 100);
  compare("Coulomb", rough(periodic, 0.2, 1.0), {3, 12, 30}, 100);
  compare("both, one particle high", rough(inelastic(periodic_box(12.0, 1.2), 0.9), 0.3, 0.7),
          {3, 6}, 50);
  compare("rough walls and particles",
          rough(inelastic(four(kRoughDriven, kThermal), 0.9), 0.3, 0.5), {2, 12, 30});
  Model<2> rough_walls_only = inelastic(four(kRoughDriven, kStatic), 0.95);
  rough_walls_only.spins = true;
  compare("smooth particles, rough walls", rough_walls_only, {2, 12});
}

TEST_CASE("Reference: gravity in any direction gives the same bits, with and without walls") {
  compare("down onto a static floor",
          falling(inelastic(with_walls(periodic_box(9.0, 8.0), 1, kStatic), 1.0), {0.0, -0.5}),
          {1, 2, 12, 30});
  compare("aslant in a driven box", falling(inelastic(four(kDriven, kDriven), 0.95), {0.3, -0.7}),
          {1, 2, 12, 30});
  compare("upwards onto a thermal ceiling",
          falling(inelastic(with_walls(periodic_box(9.0, 8.0), 1, kThermal), 0.9), {0.1, 1.0}),
          {2, 12, 30});
  compare("along a periodic axis", falling(periodic_box(9.0, 8.0), {0.5, 0.0}), {12});
  compare("strong, in a narrow channel",
          falling(inelastic(with_walls(periodic_box(12.0, 1.5), 1, kDriven), 0.9), {0.0, -30.0}),
          {2, 6});
}

TEST_CASE("Reference: walls that move give the same bits") {
  compare("saw-tooth", inelastic(with_walls(periodic_box(9.0, 8.0), 0, kSawtooth), 0.9),
          {1, 2, 12, 30});
  compare("sinusoidal", inelastic(with_walls(periodic_box(9.0, 8.0), 0, kSinusoidal), 0.9),
          {1, 2, 12, 30});
  compare("both, at corners", inelastic(four(kSinusoidal, kSawtooth), 0.9), {1, 2, 12, 30});
  Wall swinging = kSinusoidal;
  swinging.stroke = 5.0;
  swinging.frequency = 0.2;
  compare("a stroke over several cells",
          inelastic(with_walls(periodic_box(14.0, 4.0), 0, swinging), 0.9), {1, 2, 8});
  Wall quick = kSawtooth;
  quick.frequency = 500.0;
  quick.stroke = 1e-3;
  compare("fast and short", inelastic(with_walls(periodic_box(9.0, 8.0), 0, quick), 0.9), {2, 12});
  compare("shaken floor under gravity",
          falling(inelastic(with_walls(periodic_box(9.0, 20.0), 1, kSinusoidal), 0.9), {0.0, -1.0}),
          {1, 2, 12});
  compare("saw-tooth floor under gravity",
          falling(inelastic(with_walls(periodic_box(9.0, 20.0), 1, kSawtooth), 0.9), {0.0, -1.0}),
          {1, 2, 12});
}

TEST_CASE("Reference: bulk driving gives the same bits") {
  compare("smooth", kicked(inelastic(periodic_box(9.0, 8.0), 0.8), 0.05, 0.2), {2, 12, 30});
  compare("rough", kicked(rough(inelastic(periodic_box(9.0, 8.0), 0.8), 0.5, 0.5), 0.3, 0.2),
          {2, 12, 30});
  compare("between walls, under gravity",
          falling(kicked(inelastic(four(kDriven, kStatic), 0.8), 0.11, 0.1), {0.0, -0.2}), {2, 12});
}

TEST_CASE("Reference: the TC model gives the same bits") {
  compare("long t_c", with_contact_time(inelastic(four(kDriven, kLossy), 0.7), 0.1), {2, 12, 30});
  compare(
      "rough, under gravity, on a shaken floor",
      with_contact_time(
          falling(rough(inelastic(four(kStatic, kSinusoidal), 0.6), 0.3, 0.3), {0.0, -1.0}), 0.02),
      {2, 12});
  compare("wholly inelastic, kicked",
          with_contact_time(kicked(inelastic(periodic_box(9.0, 8.0), 0.0), 0.2, 0.3), 1e-3),
          {2, 12, 30});
}

TEST_CASE("Reference: everything at once gives the same bits") {
  compare("all",
          with_contact_time(
              kicked(falling(rough(inelastic(four(kSinusoidal, kRoughDriven), 0.8), 0.4, 0.6),
                             {0.2, -0.5}),
                     0.17, 0.1),
              0.01),
          {1, 2, 12, 30});
}
