#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "engine/checkpoint/archive.h"
#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"
#include "tests/support/messages.h"

using namespace clatter;
using namespace clatter::testing;

// Runs that must stop, and runs that must continue although little motion is left.

namespace {

const Wall kShaking{
    .kind = WallKind::Sinusoidal, .restitution = 0.9, .stroke = 1e-4, .frequency = 1e4};

}  // namespace

// The speed of the lone particle grows by a factor in every bounce, before a collapse.
TEST_CASE("Standstill: speeds that diverge stop the run before numbers lose their meaning") {
  for (const double restitution : {1.2, 2.0, 10.0}) {
    for (const int count : {1, 3, 100}) {
      CAPTURE(restitution);
      CAPTURE(count);
      const Model<2> model = with_walls(periodic_box(20.0, 25.0), 0, {.restitution = restitution});
      Simulation<2> simulation(model, random_gas(model, count, 951));
      CHECK(says(stop_of(simulation, 1e5), "diverges"));
      CHECK(simulation.checks().deepest_overlap < 1e-9);
      CHECK(std::isfinite(simulation.kinetic_energy()));
      CHECK(finite_and_inside(model, simulation.state()));
    }
  }
}

// Losses on another axis, or of pairs that do not exist, do not limit the speed.
TEST_CASE("Standstill: a particle that gains energy without end stops the run") {
  for (const double restitution : {1.0, 0.9}) {
    for (const bool closed : {false, true}) {
      CAPTURE(restitution);
      CAPTURE(closed);
      Model<2> model = with_walls(periodic_box(10.0, 10.0), 0, kStatic);
      model.walls[kLeft] = Wall{.kind = WallKind::Driven, .drive_speed = 1.0};
      if (closed) model = with_walls(model, 1, {.restitution = 0.9});
      model.restitution = restitution;
      Simulation<2> simulation(model, random_gas(model, 1, 952));
      CHECK(says(stop_of(simulation, 1e5), "diverges"));
    }
  }
}

TEST_CASE("Standstill: a collapse is found at the same collision in a run that was saved before") {
  Model<2> model = periodic_box(12.0, 10.0);
  model.restitution = 0.1;
  const State<2> start = random_gas(model, 60, 953);
  Simulation<2> whole(model, start);
  const std::string stop = stop_of(whole, 1e6);
  REQUIRE(says(stop, "inelastic collapse"));
  for (const std::uint64_t before : {1, 5000, 9999}) {
    CAPTURE(before);
    Simulation<2> first(model, start);
    REQUIRE_FALSE(first.run_until(1e6, whole.counts().collisions() - before));
    RunState<2> saved = first.save(), read;
    ArchiveWriter writer;
    writer(saved);
    ArchiveReader reader(writer.written(), "saved");
    reader(read);
    Simulation<2> second(model, read);
    CHECK(stop_of(second, 1e6) == stop);
    CHECK(second.counts().collisions() == whole.counts().collisions());
  }
}

TEST_CASE("Standstill: particles without room stop the run") {
  for (const double restitution : {1.0, 0.9}) {
    CAPTURE(restitution);
    Model<2> row = periodic_box(2.0, 4.0);
    row.restitution = restitution;
    Simulation<2> pair(row,
                       {.positions = {{0.5, 2.0}, {1.5, 2.0}}, .velocities = {{1, 0}, {-1, 0}}});
    CHECK(says(stop_of(pair, 1.0), "particle 0 and particle 1"));
  }
  for (const double gap : {0.0, 0x1p-52, 0x1p-51}) {
    CAPTURE(gap);
    const Model<2> slot = with_walls(periodic_box(1.0 + gap, 4.0), 0, kStatic);
    Simulation<2> single(slot, {.positions = {{0.5, 2.0}}, .velocities = {{1.0, 0.5}}});
    CHECK(says(stop_of(single, 1.0), "have no room between them at t = "));
    // Along the slot the particle is free.
    Simulation<2> slides(slot, {.positions = {{0.5, 2.0}}, .velocities = {{0.0, 0.5}}});
    CHECK(slides.run_until(100.0));
  }
  // Eleven full rows, each shifted against the one below.
  State<2> rows;
  for (int row = 0; row < 11; ++row) {
    for (int k = 0; k < 10; ++k) {
      rows.positions.push_back({std::fmod(k + 0.02 + row * 5.0 / 11.0, 10.0), row * 10.0 / 11.0});
      rows.velocities.push_back({row % 2 == 0 ? 1.0 : -0.5, 0.0});
    }
  }
  rows.velocities[3] = {0.25, 0.0};
  Simulation<2> full(periodic_box(10.0, 10.0), rows);
  CHECK(says(stop_of(full, 1.0), "have no room between them"));
}

// Room of 10^-9 diameters lets a run go on.
TEST_CASE("Standstill: a narrow room is no standstill") {
  const Model<2> slot = with_walls(periodic_box(1.0 + 1e-9, 4.0), 0, kStatic);
  Simulation<2> single(slot, {.positions = {{0.5, 2.0}}, .velocities = {{1.0, 0.5}}});
  CHECK(single.run_until(1e-4));
  CHECK(single.counts().wall_collisions > 50'000);
}

// The first bounces come late and make the particles 10^11 times as fast. This is the only growth.
TEST_CASE("Standstill: a cold gas between walls that heat it is not mistaken for a divergence") {
  Model<2> model = with_walls(periodic_box(20.0, 25.0), 0,
                              {.kind = WallKind::Driven, .restitution = 1.05, .drive_speed = 0.1});
  model.restitution = 0.8;
  State<2> start = random_gas(model, 50, 964);
  for (Vec2& v : start.velocities) v *= 1e-12;
  Simulation<2> simulation(model, start);
  CHECK_NOTHROW(simulation.run_until(kNever, 20000));
  CHECK(simulation.counts().collisions() == 20000);
  check_sound(simulation);
}

// The walls add almost no energy. The fall or the kicks set the speed of the particles.
TEST_CASE("Standstill: particles that fall or are kicked between humming walls are no divergence") {
  const Wall hums{.kind = WallKind::Sinusoidal, .stroke = 1e-6, .frequency = 1.0};
  Model<2> falls = with_walls(periodic_box(10.0, 30.0), 1, kStatic);
  falls.walls[kBottom] = hums;
  Model<2> kicked = falls;
  falls.gravity = {0.0, -1.0};
  kicked.bulk_drive = BulkDrive{0.1, 5.0, 0.0};
  for (const Model<2>& model : {falls, kicked}) {
    State<2> start = random_gas(model, 20, 965);
    for (Vec2& v : start.velocities) v = Vec2::Zero();
    for (Vec2& r : start.positions) r.y() += 0.05 * (29.5 - r.y()) / 29.0;
    Simulation<2> simulation(model, start);
    CHECK_NOTHROW(simulation.run_until(100.0));
    CHECK(simulation.counts().wall_collisions > 100);
    check_sound(simulation);
  }
}

TEST_CASE("Standstill: elastic particles at rest on a floor stop the run, unless there is a t_c") {
  Model<2> model = with_walls(periodic_box(8.0, 8.0), 1, kStatic);
  model.gravity = {0.0, -1.0};
  const State<2> start{{{2.0, 0.5}, {5.0, 0.5}}, {{0.0, 0.0}, {0.0, 0.0}}};
  Simulation<2> simulation(model, start);
  CHECK(says(stop_of(simulation, 1.0), "the bottom wall"));
  model.contact_time = 0.01;
  Simulation<2> resting(model, start);
  resting.run_until(10.0);
  CHECK(resting.time() == doctest::Approx(10.0));
  CHECK(resting.kinetic_energy() < 1e-4);
  check_sound(resting);
}

TEST_CASE("Standstill: no t_c is advised against a thermal wall that gives too little speed") {
  Model<2> model = with_walls(periodic_box(8.0, 8.0), 1, kStatic);
  model.gravity = {0.0, -1.0};
  for (const auto& [temperature, text] : {std::pair{0.0, "0"}, std::pair{1e-30, "1e-30"}}) {
    CAPTURE(temperature);
    model.walls[kBottom] = Wall{.kind = WallKind::Thermal, .temperature = temperature};
    Simulation<2> simulation(model, random_gas(model, 3, 952));
    const std::string stop = stop_of(simulation, 100.0);
    CHECK(says(stop, "time does not advance beyond t = "));
    CHECK(says(stop, std::string("emits at temperature ") + text + "; raise this temperature"));
    CHECK_FALSE(says(stop, "contact_time"));
  }
}

// Kicks and cell crossings are steps without a collision.
TEST_CASE("Standstill: a limit on steps halts a gas that never collides") {
  Model<2> kicked = periodic_box(9.0, 8.0);
  kicked.bulk_drive = BulkDrive{1e-9, 0.1, 0.0};
  Simulation<2> tight(kicked, random_gas(kicked, 2, 953));
  CHECK_FALSE(tight.run_until(1.0, kNoLimit, 1000));
  CHECK(tight.counts().steps() == 1000);
  const Model<2> free = periodic_box(9.0, 8.0);
  Simulation<2> lone(free, random_gas(free, 1, 954));
  CHECK_FALSE(lone.run_until(kNever, kNoLimit, 1000));
  CHECK(lone.counts().cell_crossings == 1000);
}

// A t_c of many periods must not add energy: it only makes the wall hits within t_c elastic.
// Without t_c T = 8; the limit allows for the energy that elastic hits conserve.
TEST_CASE("Standstill: t_c does not heat a gas between walls that shake faster") {
  Model<2> model = with_walls(periodic_box(20.0, 25.0), 0, kShaking);
  model.restitution = 0.9;
  State<2> start = random_gas(model, 100, 955);
  for (Vec2& r : start.positions) r.x() += 0.5 * (10.0 - r.x()) * 1e-3;
  for (const double contact_time : {1e-3, 1e-2}) {
    model.contact_time = contact_time;
    Simulation<2> simulation(model, start);
    double energy = 0.0;
    for (int k = 1; k <= 100; ++k) {
      simulation.run_until(50.0 + k);
      energy += simulation.kinetic_energy() / 100.0;
    }
    const double temperature = energy / 100.0;
    MESSAGE("t_c = ", contact_time, ": T = ", temperature);
    CHECK(temperature < 12.0);
    check_sound(simulation);
  }
}

// A wholly inelastic wall releases particles with its own velocity, so that each grazes it at the
// start of its flight. After a move of the base this must not count as a past contact.
TEST_CASE("Standstill: the clock never steps back at moving walls that particles just left") {
  for (std::uint64_t seed = 956; seed < 962; ++seed) {
    Model<2> model = with_walls(with_walls(periodic_box(20.0, 25.0), 0, kStatic), 1, kStatic);
    model.walls[kBottom] =
        Wall{.kind = WallKind::Sinusoidal, .restitution = 0.0, .stroke = 0.1, .frequency = 20.0};
    model.restitution = 0.8;
    model.gravity = {0.0, -1.0};
    model.contact_time = 1e-5;
    State<2> start = random_gas(model, 100, seed);
    for (Vec2& r : start.positions) r.y() += 0.05 * (24.5 - r.y()) / 24.0;
    Simulation<2> simulation(model, start);
    simulation.run_until(20.0);
    check_sound(simulation);
  }
}

TEST_CASE("Standstill: a run continues between walls that move differently") {
  const Model<2> before = with_walls(periodic_box(20.0, 25.0), 0, kStatic);
  Simulation<2> first(before, random_gas(before, 100, 963));
  first.run_until(20.0);
  Model<2> after = before;
  after.walls[kLeft] =
      Wall{.kind = WallKind::Sawtooth, .stroke = 2.0, .frequency = 1.0, .phase = 0.0};
  Simulation<2> second(after, first.save());  // t = 20: the wall is at its rest position
  second.run_until(30.0);
  check_sound(second);
}

// While the wall is far back, the particle passes its rest position and returns. A new static wall
// at the rest position has not been hit in the past.
TEST_CASE("Standstill: a new wall is not hit by the past of a flight") {
  Model<2> before = with_walls(periodic_box(20.0, 25.0), 0, kStatic);
  before.walls[kLeft] =
      Wall{.kind = WallKind::Sinusoidal, .stroke = 2.0, .frequency = 1e-3, .phase = 0.75};
  before.gravity = {1.0, 0.0};
  Simulation<2> first(before, State<2>{{{1.5, 3.0}}, {{-1.6, 0.0}}});  // to .22, back at t = 3.2
  first.run_until(3.0);
  REQUIRE(first.counts().wall_collisions == 0);
  Model<2> after = before;
  after.walls[kLeft] = kStatic;
  Simulation<2> second(after, first.save());
  second.run_until(4.0);
  CHECK(second.counts().wall_collisions == 0);
  CHECK(second.state().positions[0].x() == doctest::Approx(1.5 - 1.6 * 4.0 + 8.0));
  check_sound(second);
}
