#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE(
    "Scales: a graze at b = 1 - 1e-12" *
    doctest::description("deflected as theory 3.2 says within 1e-4, which is the rounding of b")) {
  // The impulse (1 + alpha)/2 |g_n| along n has the component (1 + alpha)/2 sqrt((1-b)(1+b)) b
  // across the flight. b is the stored number; 1 - b is exact.
  double worst = 0.0;
  for (const double restitution : {1.0, 0.9, 0.0}) {
    for (const double distance : {1.25, 3.0, 25.0}) {
      for (const double speed : {1.0, 1e-3, 0.7e5}) {
        Model<2> model = periodic_box(64.0, 8.0);
        model.restitution = restitution;
        State<2> start;
        start.positions = {{4.0, 2.0 - 1e-12}, {4.0 + distance, 1.0}};
        start.velocities = {{speed, 0.0}, {0.0, 0.0}};
        const double b = start.positions[0].y() - start.positions[1].y();
        REQUIRE(b < 1.0);
        Simulation<2> simulation(model, start);
        simulation.run_until(kNever, 1);
        const State<2> state = simulation.state();
        const double across =
            0.5 * (1.0 + restitution) * std::sqrt((1.0 - b) * (1.0 + b)) * b * speed;
        CAPTURE(restitution);
        CAPTURE(distance);
        CAPTURE(speed);
        for (const double y : {state.velocities[0].y(), -state.velocities[1].y()}) {
          worst = std::max(worst, std::fabs(y / across - 1.0));
        }
        CHECK(simulation.counts().pair_collisions == 1);
        check_sound(simulation);
      }
    }
  }
  MESSAGE("off by ", brief(worst));
  CHECK(worst < 1e-4);
}

TEST_CASE("Scales: particles that meet, or miss, after 1000 diameters" *
          doctest::description("contact within 1e-10 of a diameter, none missed or invented beyond "
                               "rounding of b")) {
  // The discriminant is the difference of two numbers near 10^6. b is within 10^-k of grazing.
  double worst = 0.0;
  int met = 0;
  for (int k = 1; k <= 12; ++k) {
    for (int n = 0; n < 200; ++n) {
      Random random(926, Stream::Placement, static_cast<std::uint32_t>(k),
                    static_cast<std::uint32_t>(n));
      const double turn = 2.0 * std::numbers::pi * random.uniform();
      const Vec2 along(std::cos(turn), std::sin(turn)), across(-along.y(), along.x());
      const double beside = (n % 2 ? 1.0 : -1.0) * std::pow(10.0, -k) * random.uniform();
      const Vec2 middle(1500.0, 1500.0);
      const Vec2 far = middle - 1000.0 * along + (1.0 - beside) * across;
      const Model<2> model = with_walls(periodic_box(3000.0, 3000.0), 0, kStatic);
      Simulation<2> simulation(model, State<2>{{far, middle}, {3.0 * along, {0.0, 0.0}}});
      simulation.run_until(340.0);
      // Stored numbers have rounding errors of 2e-13 in position and 2e-16 in direction: 1e-12 over
      // the path.
      if (std::fabs(beside) > 1e-12) {
        CAPTURE(beside);
        CHECK(simulation.counts().pair_collisions == (beside > 0.0 ? 1 : 0));
      }
      met += static_cast<int>(simulation.counts().pair_collisions);
      worst = std::max({worst, simulation.checks().deepest_overlap,
                        brute_force_overlap(model, simulation.state())});
    }
  }
  MESSAGE(met, " of 2400 met, deepest overlap ", brief(worst));
  CHECK(worst <= 1e-10);
}

TEST_CASE("Scales: lengths scaled by 2^+-40 and speeds by 2^+-30, everything at once" *
          doctest::description("bit-identical runs")) {
  const Model<2> model = everything();
  const State<2> start = clear_gas(model, 20, 906);
  Simulation<2> plain(model, start);
  plain.run_until(kNever, 3000);
  for (const int length : {-40, 40}) {
    for (const int speed : {-30, 30}) {
      const double l = std::ldexp(1.0, length), s = std::ldexp(1.0, speed);
      Model<2> scaled = model;
      scaled.box *= l;
      scaled.diameter *= l;
      scaled.gravity *= s * s / l;
      scaled.bulk_drive =
          BulkDrive{model.bulk_drive->interval * (l / s), model.bulk_drive->kick_speed * s,
                    model.bulk_drive->kick_spin * (s / l)};
      scaled.contact_time = *model.contact_time * (l / s);
      for (auto& wall : scaled.walls) {
        wall->drive_speed *= s;
        wall->temperature *= s * s;
        wall->stroke *= l;
        wall->frequency *= s / l;
      }
      State<2> scaled_start = start;
      for (Vec2& r : scaled_start.positions) r *= l;
      for (Vec2& v : scaled_start.velocities) v *= s;
      for (Spin<2>& w : scaled_start.spins) w *= s / l;
      Simulation<2> simulation(scaled, scaled_start);
      simulation.run_until(kNever, 3000);
      State<2> state = simulation.state();
      for (Vec2& r : state.positions) r /= l;
      for (Vec2& v : state.velocities) v /= s;
      for (Spin<2>& w : state.spins) w /= s / l;
      CHECK(state_hash<2>(state) == plain.state_hash());
      CHECK(simulation.counts().kicks == plain.counts().kicks);
      CHECK(simulation.counts().elasticised == plain.counts().elasticised);
    }
  }
  CHECK(plain.counts().kicks > 10);
  CHECK(plain.counts().elasticised > 10);
  MESSAGE(plain.counts().collisions(), " collisions, four scalings, the same bits");
}

// The first particles reach the walls late and leave them fast. Without a move of the time base,
// rounding errors of the times correspond to paths of 1e-10 diameters.
TEST_CASE("Scales: a gas of speeds 1e-4, 1e-8, 1e-12 between walls that drive at 1" *
          doctest::description("same bits as brute force, overlap below 1e-12")) {
  double deepest = 0.0;
  for (const double speed : {1e-4, 1e-8, 1e-12}) {
    CAPTURE(speed);
    Model<2> model = with_walls(periodic_box(20.0, 25.0), 0, kDriven);
    model.restitution = 0.9;
    State<2> start = random_gas(model, 100, 912);
    for (Vec2& v : start.velocities) v *= speed;
    Simulation<2> simulation(model, start);
    const BaseMoves<2> moves(simulation);
    Reference<2> reference(model, start, moves);
    simulation.run_until(kNever, 100);
    reference.run_until_collisions(100);
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    simulation.run_until(kNever, 20000);
    deepest = std::max(deepest, simulation.checks().deepest_overlap);
    check_sound(simulation);
  }
  MESSAGE("deepest overlap ", brief(deepest));
}

TEST_CASE("Scales: speeds that differ by 1e12" *
          doctest::description("same bits as brute force; energy 1e-12, overlap below 1e-10")) {
  double energy_off = 0.0, deepest = 0.0;
  // One particle of speed 1e6 among others of speed 1e-6, which it hits one after the other. Also
  // with a wall that oscillates at a speed of order 1.
  for (const bool walled : {false, true}) {
    Model<2> model = periodic_box(9.0, 8.0);
    if (walled) {
      Wall wall = kSinusoidal;
      wall.restitution = 1.0;
      model = with_walls(with_walls(model, 0, wall), 1, kStatic);
    }
    State<2> start = clear_gas(model, 12, 907);
    for (Vec2& v : start.velocities) v *= 1e-6;
    start.velocities[5] *= 1e12;
    Simulation<2> simulation(model, start);
    const double energy = simulation.kinetic_energy();
    const BaseMoves<2> moves(simulation);
    Reference<2> reference(model, start, moves);
    simulation.run_until(kNever, 300);
    reference.run_until_collisions(300);
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    simulation.run_until(kNever, 20000);
    if (!walled) energy_off = std::fabs(simulation.kinetic_energy() / energy - 1.0);
    CHECK(finite_and_inside(model, simulation.state()));
    deepest =
        std::max({deepest, simulation.deepest_overlap(), simulation.checks().deepest_overlap});
  }
  MESSAGE("energy off by ", brief(energy_off), ", deepest overlap ", brief(deepest));
  CHECK(energy_off < 1e-12);
  CHECK(deepest < 1e-10);
}
