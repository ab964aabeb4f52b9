#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"
#include "tests/support/messages.h"

using namespace clatter;
using namespace clatter::testing;

// Inelastic collapse: piles, rows and bouncing balls that collapse are reported. A t_c continues
// them. Similar systems without a collapse run through.

namespace {

// Its acceleration is .18 at most. Particles on it stay there under gravity 1.
const Wall kGentle{
    .kind = WallKind::Sinusoidal, .restitution = 0.9, .stroke = 0.1, .frequency = 0.3};
// A row of particles along x that all move towards the first.
State<2> row(int count, double spacing) {
  State<2> start;
  for (int i = 0; i < count; ++i) {
    start.positions.push_back({1.0 + spacing * i, 2.0});
    start.velocities.push_back({i == 0 ? 0.5 : -1.0, 0.0});
  }
  return start;
}

// The t_c that a message recommends.
double advised_contact_time(const std::string& message) {
  const std::string key = "collapse.contact_time to ";
  const std::size_t at = message.find(key);
  REQUIRE_MESSAGE(at != std::string::npos, message);
  return std::stod(message.substr(at + key.size()));
}

}  // namespace

TEST_CASE("Collapse: a pile with alpha = 0 and a t_c, on every kind of floor" *
          doctest::description("time advances, overlap below 1e-9; on a static or slowly moving "
                               "floor vertical speeds stay below 0.3")) {
  for (const Wall& kind : {kStatic, kSawtooth, kSinusoidal, kGentle}) {
    CAPTURE(static_cast<int>(kind.kind));
    Wall floor = kind;
    floor.restitution = 0.0;
    Model<2> model = periodic_box(6.0, 12.0);
    model.walls[kBottom] = floor;
    model.walls[kTop] = kStatic;
    model.restitution = 0.0;
    model.gravity = {0.0, -1.0};
    model.contact_time = 0.02;
    Simulation<2> simulation(model, clear_gas(model, 10, 908));
    for (int k = 1; k <= 40; ++k) {
      REQUIRE_NOTHROW(simulation.run_until(k));
      REQUIRE(simulation.deepest_overlap() < 1e-9);
    }
    CHECK(simulation.checks().deepest_overlap < 1e-9);
    // Motion that t_c leaves: hops of some t_c with a speed of g t_c, and sliding without friction.
    double vertical = 0.0;
    for (const Vec2& v : simulation.state().velocities)
      vertical = std::max(vertical, std::fabs(v.y()));
    MESSAGE(simulation.counts().collisions(), " collisions, largest vertical speed ",
            brief(vertical));
    if (floor.kind == WallKind::Static || floor.frequency == kGentle.frequency) {
      CHECK(vertical < 0.3);
    }
  }
}

TEST_CASE("Collapse: inelastic collapse of a bouncing ball" *
          doctest::description("the run stops within 1e-5 of the time of the collapse, and "
                               "continues with the recommended t_c")) {
  // Dropped from h, the ball lands after t_0 = sqrt(2h/g). The bounces sum to t_0 (1 + alpha)/(1 -
  // alpha).
  for (const double restitution : {0.9, 0.5, 0.0}) {
    CAPTURE(restitution);
    Model<2> model = with_walls(periodic_box(6.0, 12.0), 1, {.restitution = restitution});
    model.gravity = {0.0, -0.5};
    State<2> start{{{3.0, 4.5}}, {{0.0, 0.0}}};
    Simulation<2> simulation(model, start);
    const std::string message = stop_of(simulation, 1e6);
    const double end = 4.0 * (1.0 + restitution) / (1.0 - restitution);
    CAPTURE(message);
    CHECK(says(message, "particle 0 and the bottom wall collide without end"));
    MESSAGE("alpha = ", restitution, ": time off by ", brief(simulation.time() / end - 1.0));
    CHECK(std::fabs(simulation.time() / end - 1.0) < 1e-5);
    CHECK(simulation.state().positions[0].y() == doctest::Approx(0.5).epsilon(1e-9));
    // With the recommended t_c the ball continues to hop.
    model.contact_time = advised_contact_time(message);
    Simulation<2> on(model, start);
    CHECK(stop_of(on, end + 1e5 * *model.contact_time) == "");
    CHECK(on.checks().deepest_overlap < 1e-9);
  }
}

TEST_CASE("Collapse: particles on floors under gravity" *
          doctest::description("without t_c the run ends, or stops with an error that recommends a "
                               "t_c; with this t_c it continues; overlap below 1e-9")) {
  for (const Wall& kind : {kStatic, kLossy, kSawtooth, kSinusoidal, kGentle, kRoughDriven}) {
    for (const double restitution : {0.0, 0.5}) {
      CAPTURE(static_cast<int>(kind.kind));
      CAPTURE(restitution);
      Wall floor = kind;
      floor.restitution = std::min(floor.restitution, restitution);
      Model<2> model = with_walls(rough(periodic_box(6.0, 12.0), 0.5, 0.5), 1, floor);
      model.restitution = restitution;
      model.gravity = {0.0, -1.0};
      const State<2> start = clear_gas(model, 12, 909);
      Simulation<2> simulation(model, start);
      const std::string stop = stop_of(simulation, 50.0);
      if (stop.empty()) CHECK(simulation.time() == 50.0);
      CHECK(finite_and_inside(model, simulation.state()));
      CHECK(simulation.deepest_overlap() < 1e-9);
      if (stop.empty()) continue;
      CHECK(says(stop, "inelastic collapse"));
      model.contact_time = advised_contact_time(stop);
      Simulation<2> on(model, start);
      CHECK(stop_of(on, simulation.time() + 1000.0 * *model.contact_time) == "");
      CHECK(on.deepest_overlap() < 1e-9);
    }
  }
}

TEST_CASE("Collapse: rows of particles in one dimension" *
          doctest::description("the run stops with an error that names the particles, and "
                               "continues with the recommended t_c; overlap below 1e-11")) {
  // In one dimension three free particles collapse below alpha = 7 - 4 sqrt(3) = .072 (McNamara &
  // Young 1992), longer rows at larger alpha.
  struct Row {
    int count;
    double restitution;
  };
  for (const Row& r : {Row{3, 0.05}, Row{12, 0.3}, Row{20, 0.5}}) {
    CAPTURE(r.count);
    Model<2> model = with_walls(periodic_box(45.0, 4.0), 0, kStatic);
    model.restitution = r.restitution;
    const State<2> start = row(r.count, 1.5);
    Simulation<2> simulation(model, start);
    const std::string message = stop_of(simulation, 1000.0);
    CHECK(says(message, "inelastic collapse"));
    CHECK(says(message, " and particle "));
    CHECK(simulation.deepest_overlap() < 1e-11);
    model.contact_time = advised_contact_time(message);
    Simulation<2> on(model, start);
    CHECK(stop_of(on, 1000.0) == "");
    CHECK(on.time() == 1000.0);
    CHECK(on.deepest_overlap() < 1e-11);
    for (const Vec2& r_i : on.state().positions) CHECK(r_i.y() == 2.0);
  }
}

// The resumed run stands still from its first collision. Its own mean time between collisions would
// be far too short.
TEST_CASE("Collapse: restart of a run that stopped by inelastic collapse" *
          doctest::description("it stops again and recommends the same t_c")) {
  Model<2> model = with_walls(periodic_box(45.0, 4.0), 0, kStatic);
  model.restitution = 0.3;
  Simulation<2> first(model, row(12, 1.5));
  const std::string message = stop_of(first, 1000.0);
  Simulation<2> second(model, first.save());
  const std::string again = stop_of(second, 1000.0);
  CAPTURE(message);
  CAPTURE(again);
  CHECK(advised_contact_time(again) == advised_contact_time(message));
  Simulation<2> third(model, second.save());
  CHECK(advised_contact_time(stop_of(third, 1000.0)) == advised_contact_time(message));
}

TEST_CASE(
    "Collapse: the recommended t_c" *
    doctest::description(
        "1e-3 of the mean time between collisions before the collapse, within a factor of ten")) {
  // The time of the collapse does not matter. A t_c of a thousandth of it would make resting grains
  // hop a thousand times as often. The ball needs 100 bounces for the last 10^-4 of its time. The
  // row has some ten collisions per particle before it collapses.
  Model<2> ball = with_walls(periodic_box(6.0, 12.0), 1, {.restitution = 0.9});
  ball.gravity = {0.0, -0.5};
  Simulation<2> bouncing(ball, State<2>{{{3.0, 4.5}}, {{0.0, 0.0}}});
  const double ball_time = 1e3 * advised_contact_time(stop_of(bouncing, 1e6));
  MESSAGE("mean time of the ball ", brief(ball_time));
  CHECK(ball_time > 0.4);  // 76 time units, the first flights 7
  CHECK(ball_time < 8.0);
  Model<2> pile = with_walls(periodic_box(6.0, 12.0), 1, {.restitution = 0.5});
  pile.restitution = 0.5;
  pile.gravity = {0.0, -1.0};
  const State<2> start = clear_gas(pile, 12, 909);
  Simulation<2> falling(pile, start), first(pile, start);
  const double pile_time = 1e3 * advised_contact_time(stop_of(falling, 1e6));
  first.run_until(kNever, 60);  // ten for each particle
  const double expected =
      first.time() * 12.0 /
      static_cast<double>(2 * first.counts().pair_collisions + first.counts().wall_collisions);
  MESSAGE("of the pile ", brief(pile_time), ", in its first collisions ", brief(expected));
  CHECK(pile_time > 0.1 * expected);
  CHECK(pile_time < 10.0 * expected);
}

TEST_CASE(
    "Collapse: detection of an inelastic collapse" *
    doctest::description("the run has the same bits as a brute-force run without detection")) {
  // The reference does not detect a standstill. Rows with a very small t_c come close to a
  // collapse. A thermal wall does not use its restitution, but the restitution enables the
  // detection.
  Model<2> model = with_walls(periodic_box(45.0, 4.0), 0, kStatic);
  model.restitution = 0.3;
  model.contact_time = 1e-9;
  const State<2> start = row(8, 1.5);
  Simulation<2> simulation(model, start);
  run_beside_reference(simulation, start, 8000);
  CHECK(simulation.counts().elasticised > 1000);

  Model<2> plain = with_walls(periodic_box(9.0, 8.0), 0, kThermal);
  Model<2> looked_at = plain;
  looked_at.walls[kLeft]->restitution = 0.5;
  const State<2> gas = random_gas(plain, 20, 910);
  Simulation<2> a(plain, gas), b(looked_at, gas);
  a.run_until(kNever, 200000);
  b.run_until(kNever, 200000);
  CHECK(a.state_hash() == b.state_hash());
  MESSAGE("the same bits after ", simulation.counts().collisions(), " collisions of a row, ",
          a.counts().collisions(), " of a gas");
}

TEST_CASE(
    "Collapse: dense, fast and hot gases" *
    doctest::description("no collapse is reported in 2e5 collisions each, overlap below 1e-11")) {
  // 2 10^5 collisions each, three times the limit of a standstill. The gases: 72 inelastic kicked
  // particles at phi = .68; a gas from T = 1 between walls of T_w = 1e16; inelastic particles
  // between walls with gain.
  Model<2> dense = periodic_box(9.2, 9.0);
  dense.restitution = 0.9;
  dense.bulk_drive = BulkDrive{0.01, 0.1, 0.0};
  Wall hot = kThermal;
  hot.temperature = 1e16;
  Model<2> heated = with_walls(periodic_box(10.0, 9.0), 0, hot);
  heated.restitution = 0.95;
  Model<2> gaining =
      with_walls(periodic_box(10.0, 9.0), 0,
                 {.kind = WallKind::Driven, .restitution = 1.05, .drive_speed = 0.1});
  gaining.restitution = 0.8;
  int count = 72;
  for (const Model<2>& model : {dense, heated, gaining}) {
    Simulation<2> simulation(model, random_gas(model, count, 911));
    CHECK_NOTHROW(simulation.run_until(kNever, 200000));
    CHECK(simulation.counts().collisions() == 200000);
    CHECK(finite_and_inside(model, simulation.state()));
    const double overlap = brute_force_overlap(model, simulation.state());
    MESSAGE("overlap ", brief(overlap));
    CHECK(overlap < 1e-11);
    count = 30;
  }
}
