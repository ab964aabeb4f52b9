#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"
#include "tests/support/messages.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE(
    "Heating: 100 particles between walls of restitution 1.05" *
    doctest::description("the run stops with an error, at a time within 5 % of t* (theory 7.16)")) {
  // alpha = 1, alpha_w = 1.05, no drive, N = 100, 20 x 25: T = T_0/(1 + k t)^2 with k < 0,
  // corrected for the layer at the walls (theory 7.15), so t* = 1/|k|. 6 seeds, mean t* to 1 %,
  // within 5 %.
  constexpr int kSeeds = 6;
  Scene scene = gas(20.0, 25.0, 100, 1.0);
  wall_in(scene, 0, {.kind = WallKind::Static, .restitution = 1.05});
  const VibratedGas theory{100.0, 20.0, 25.0, 1.0, 1.05, 0.0};
  const double expected = divergence_time(theory.haff_rate_corrected(1.0));
  Sample times;
  for (std::uint64_t seed = 501; seed < 501 + kSeeds; ++seed) {
    Simulation<2> simulation(model_of<2>(scene, seed), start_state<2>(scene, seed));
    const std::string message = stop_of(simulation, 10.0 * expected);
    CHECK(says(message, "the temperature diverges"));
    times.add(simulation.time());
    CHECK(std::isfinite(simulation.kinetic_energy()));
    CHECK(simulation.kinetic_energy() > 1e6 * 100.0);
    CHECK(finite_and_inside(simulation.model(), simulation.state()));
    CHECK(simulation.deepest_overlap() < 1e-9);
  }
  MESSAGE("t* = ", times.mean(), " +- ", times.standard_error(), ", theory ", expected,
          ", theory without the layer at the walls ",
          divergence_time(theory.haff_rate_refined(1.0)));
  CHECK(times.standard_error() < 0.01 * expected);
  CHECK(std::fabs(times.mean() / expected - 1.0) < 0.05);
}

TEST_CASE("Heating: one particle between walls of restitution 1.05" *
          doctest::description("the run stops with an error, at a time within 1e-5 of the summed "
                               "times of its crossings")) {
  // v grows by 1.05 with each crossing of 9: the times sum to 9/v (1 + 1/1.05 + ...) = 21 * 9/v.
  const Wall gaining{.restitution = 1.05};
  Model<2> model = with_walls(periodic_box(10.0, 9.0), 0, gaining);
  Simulation<2> simulation(model, State<2>{{{0.5, 3.0}}, {{2.0, 0.25}}});
  const std::string message = stop_of(simulation, 1e6);
  CHECK(says(message, "the temperature diverges"));
  const double off = simulation.time() / (21.0 * 9.0 / 2.0) - 1.0;
  MESSAGE("t off by ", brief(off), ": ", message);
  CHECK(std::fabs(off) < 1e-5);
  CHECK(finite_and_inside(model, simulation.state()));
  CHECK(simulation.state().velocities[0].y() == 0.25);
}

TEST_CASE("Heating: one elastic particle between elastic walls, driven or saw-tooth" *
          doctest::description("the run stops with an error that has time and speed, after at most "
                               "3e6 hits; so does a restart")) {
  const Wall pushes{.kind = WallKind::Driven, .drive_speed = 1.0};
  const Wall saws{.kind = WallKind::Sawtooth, .stroke = 0.1, .frequency = 5.0};
  for (const Wall& wall : {pushes, saws}) {
    const Model<2> model = with_walls(periodic_box(10.0, 9.0), 0, wall);
    Simulation<2> simulation(model, State<2>{{{5.0, 3.0}}, {{1.0, 0.25}}});
    const std::string message = stop_of(simulation, 1e9);
    MESSAGE(simulation.counts().wall_collisions, " wall hits: ", message);
    CHECK(says(message, "the temperature diverges at t = "));
    CHECK(says(message, ", a speed of 1.0"));
    CHECK(simulation.counts().wall_collisions < 3'000'000);
    CHECK(finite_and_inside(model, simulation.state()));
    check_sound(simulation);

    Simulation<2> first(model, State<2>{{{5.0, 3.0}}, {{1.0, 0.25}}});
    first.run_until(kNever, 1000);
    Simulation<2> second(model, first.save());
    CHECK(stop_of(second, 1e9) == message);
  }
}

// No divergence: a drive that is negligible for the particles, and a gas with dissipative particles
// or walls.
TEST_CASE("Heating: gases without unbounded heating" *
          doctest::description(
              "runs continue with a weak drive, with sinusoidal walls, and with losses")) {
  Wall weak{.kind = WallKind::Driven, .drive_speed = 1e-9};
  Wall swings{.kind = WallKind::Sinusoidal, .stroke = 0.1, .frequency = 1.0};
  Wall strong{.kind = WallKind::Driven, .drive_speed = 1.0};
  for (const Wall& wall : {weak, swings}) {
    const Model<2> model = with_walls(periodic_box(10.0, 9.0), 0, wall);
    Simulation<2> simulation(model, clear_gas(model, 1, 957));
    simulation.run_until(kNever, 20000);
    CHECK(simulation.kinetic_energy() < 1e6);
  }
  const Model<2> lossy = inelastic(with_walls(periodic_box(10.0, 9.0), 0, strong), 0.9999);
  State<2> start = random_gas(lossy, 20, 958);
  for (Vec2& v : start.velocities) v *= 1e7;
  Simulation<2> simulation(lossy, start);
  CHECK_NOTHROW(simulation.run_until(kNever, 20000));
}
