#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/error.h"
#include "engine/measure/totals.h"
#include "engine/physics/collision.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"

using namespace clatter;
using namespace clatter::testing;

// Where numbers are few, huge, tiny or equal: nothing may hang, overlap or depend on the units.

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Wall kElastic{};
const Wall kLossy{.restitution = 0.9};
const Wall kDriven{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.0};
const Wall kThermal{.kind = WallKind::Thermal, .temperature = 2.0};
const Wall kSawtooth{
    .kind = WallKind::Sawtooth, .restitution = 0.9, .stroke = 0.25, .frequency = 2.0, .phase = 0.5};
const Wall kSinusoidal{
    .kind = WallKind::Sinusoidal, .restitution = 0.9, .stroke = 0.5, .frequency = 0.5};
// Its acceleration is .18 at most, so that what lies on it under gravity 1 stays.
const Wall kGentle{
    .kind = WallKind::Sinusoidal, .restitution = 0.9, .stroke = 0.1, .frequency = 0.3};
const Wall kRoughDriven{.kind = WallKind::Driven,
                        .restitution = 0.9,
                        .roughness = {.friction = 0.3, .tangential_restitution = 0.5},
                        .drive_speed = 1.0};

// A gas that stays clear of where walls go, here .5 at most; with spins where they are carried.
State<2> clear_gas(const Model<2>& model, int count, std::uint64_t seed) {
  Model<2> inner = model;
  inner.box -= Vec2(1.0, 1.0);
  State<2> state = random_gas(inner, count, seed);
  for (Vec2& r : state.positions) r += Vec2(0.5, 0.5);
  for (int i = 0; model.spins && i < count; ++i) state.spins.push_back(Spin<2>(0.3 * i - 1.0));
  return state;
}

Model<2> rough(Model<2> model, double friction, double tangential_restitution) {
  model.roughness = {friction, tangential_restitution};
  model.spins = true;
  return model;
}

// All there is: every kind of wall that forgets nothing or little, rough disks, gravity, kicks,
// t_c.
Model<2> everything() {
  Model<2> model = rough(periodic_box(10.0, 9.0), 0.4, 0.6);
  model.walls = {kSinusoidal, kSawtooth, kRoughDriven, kThermal};
  model.restitution = 0.875;
  model.gravity = {0.25, -0.5};
  model.bulk_drive = BulkDrive{0.1875, 0.125, 0.0625};
  model.contact_time = 0.0078125;
  return model;
}

// Runs to a time and says what stopped it before; empty: nothing.
std::string stop_of(Simulation<2>& simulation, double end) {
  try {
    simulation.run_until(end);
  } catch (const PhysicalStop& stop) {
    return stop.what();
  }
  return "";
}

// A row of disks along x that all fall upon the first.
State<2> row(int count, double spacing) {
  State<2> start;
  for (int i = 0; i < count; ++i) {
    start.positions.push_back({1.0 + spacing * i, 2.0});
    start.velocities.push_back({i == 0 ? 0.5 : -1.0, 0.0});
  }
  return start;
}

// The t_c that a message advises.
double advised_contact_time(const std::string& message) {
  const std::string key = "collapse.contact_time = ";
  const std::size_t at = message.find(key);
  REQUIRE_MESSAGE(at != std::string::npos, message);
  return std::stod(message.substr(at + key.size()));
}

}  // namespace

TEST_CASE("extremes: no, one and two disks between walls of every kind come to the end") {
  const std::optional<Wall> walls[] = {std::nullopt, kElastic,  kLossy,      kDriven,
                                       kThermal,     kSawtooth, kSinusoidal, kRoughDriven};
  for (const auto& wall : walls) {
    for (int features = 0; features < 8; ++features) {
      Model<2> model = rough(periodic_box(7.0, 6.0), 0.3, 0.5);
      if (wall) model = with_walls(with_walls(model, 0, *wall), 1, *wall);
      model.restitution = 0.9;
      if (features & 1) model.gravity = {0.2, -1.0};
      if (features & 2) model.bulk_drive = BulkDrive{0.3, 0.2, 0.1};
      if (features & 4) model.contact_time = 1e-3;
      for (int count = 0; count <= 2; ++count) {
        CAPTURE(features);
        CAPTURE(count);
        if (wall) CAPTURE(static_cast<int>(wall->kind));
        Simulation<2> simulation(model, clear_gas(model, count, 901));
        const std::string stop = stop_of(simulation, 50.0);
        // Grains may come to rest under gravity; with t_c that is no end.
        CHECK_MESSAGE((stop.empty() || (features & 5) == 1), stop);
        if (stop.empty()) CHECK(simulation.time() == 50.0);
        CHECK(simulation.counts().kicks == ((features & 2) && stop.empty() ? 166 : 0));
        CHECK(finite_and_inside(model, simulation.state()));
        CHECK(simulation.deepest_overlap() < 1e-9);
        CHECK(simulation.checks().deepest_overlap < 1e-9);
      }
    }
  }
}

TEST_CASE("extremes: kicks of one disk are nothing, of two opposite") {
  Model<2> model = periodic_box(7.0, 6.0);
  model.bulk_drive = BulkDrive{0.3, 0.2, 0.0};
  const State<2> one = random_gas(model, 1, 902);
  Simulation<2> alone(model, one);
  alone.run_until(10.0);
  CHECK(alone.counts().kicks == 33);
  CHECK(alone.state().velocities[0] == one.velocities[0]);
  Simulation<2> both(model, random_gas(model, 2, 902));
  both.run_until(10.0);
  CHECK(momentum(both.state()).norm() < 1e-13);
}

TEST_CASE("extremes: rough disks touch through images that are not the nearest") {
  // In a box lower than two diameters: each collision is whole (the separation one diameter, the
  // loss that of section 2), whichever image it is through.
  class Images : public Observer<2> {
   public:
    explicit Images(const Model<2>& model) : model_(model) {}
    int far = 0;
    double longest = 0.0;
    double worst_loss = 0.0;
    void on_collision(const PairCollision<2>& c) override {
      far += std::fabs(separation_at_prediction(c).y()) > 0.5 * model_.box.y();
      longest = std::max(longest, std::fabs(c.separation.norm() - 1.0));
      const ContactLaw law{model_.restitution, kInfinity, 0.5};
      const double loss =
          dissipated_energy<2>(c.separation, c.disks[0].velocity - c.disks[1].velocity,
                               c.disks[0].spin + c.disks[1].spin, law, model_.inertia, 1.0);
      const double lost = -(c.disks[0].energy + c.disks[1].energy);
      worst_loss = std::max(worst_loss, std::fabs(lost - loss));
    }

   private:
    // Through the image that touches in the end, when the later of the two flights began.
    static Vec2 separation_at_prediction(const PairCollision<2>& c) {
      const Flight<2>&a = c.disks[0].before, &b = c.disks[1].before;
      const double time = std::max(a.time, b.time);
      const Vec2 shift = c.separation - (c.disks[0].position - c.disks[1].position);
      return a.at(time, Vec2::Zero()) - b.at(time, Vec2::Zero()) + shift;
    }
    const Model<2>& model_;
  };
  for (const double height : {1.2, 2.05}) {
    CAPTURE(height);
    Model<2> model = rough(with_walls(periodic_box(12.0, height), 0, kDriven), kInfinity, 0.5);
    model.restitution = 0.95;
    const State<2> start = random_gas(model, 6, 903);
    Simulation<2> simulation(model, start);
    Images images(model);
    simulation.add_observer(images);
    Reference reference(model, start);
    simulation.run_until(kNever, 3000);
    reference.run_until_collisions(3000);
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    MESSAGE(images.far, " of ", simulation.counts().disk_disk, " collisions through such images");
    CHECK(images.far > 50);
    CHECK(images.longest < 1e-12);
    CHECK(images.worst_loss < 1e-11);
    CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
    check_sound(simulation);
  }
}

TEST_CASE("extremes: a graze at b = 1 - 1e-12 turns the disk by what Eq. (2.4) says") {
  // The impulse (1 + alpha)/2 |g_n| along n has the part (1 + alpha)/2 sqrt((1-b)(1+b)) b across
  // the flight. b is what is stored; 1 - b is exact.
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
        CHECK(std::fabs(state.velocities[0].y() / across - 1.0) < 1e-4);
        CHECK(std::fabs(state.velocities[1].y() / -across - 1.0) < 1e-4);
        CHECK(simulation.counts().disk_disk == 1);
        check_sound(simulation);
      }
    }
  }
}

TEST_CASE("extremes: moving walls at t = 1e9 are where they are at t = 0") {
  for (const Wall& wall : {kSawtooth, kSinusoidal}) {
    for (const double frequency : {0.5, 2.0, 0.7}) {
      CAPTURE(frequency);
      Wall moving = wall;
      moving.frequency = frequency;
      Model<2> model = with_walls(with_walls(periodic_box(10.0, 9.0), 0, moving), 1, moving);
      model.restitution = 0.9;
      model.gravity = {0.0, -0.5};
      const State<2> start = clear_gas(model, 20, 904);
      Simulation<2> early(model, start), late(model, start, 1e9);
      early.run_until(kNever, 3000);
      late.run_until(kNever, 3000);
      // Of .7 the double is meant: 1e9 times it is no whole number of periods.
      if (frequency != 0.7) CHECK(late.state_hash() == early.state_hash());
      CHECK(late.checks().deepest_overlap <= 1e-12);
      CHECK(late.deepest_overlap() <= 1e-12);
      check_sound(late);
    }
  }
}

TEST_CASE("extremes: everything at once from t = 1e12 is what it is from 0") {
  Model<2> model = everything();
  const State<2> start = clear_gas(model, 20, 905);
  Simulation<2> early(model, start), late(model, start, 1e12);
  early.run_until(kNever, 3000);
  late.run_until(kNever, 3000);
  CHECK(late.counts().kicks == early.counts().kicks);
  CHECK(late.counts().kicks > 10);
  CHECK(late.state_hash() == early.state_hash());
  CHECK(late.time() - 1e12 == doctest::Approx(early.time()).epsilon(1e-3));
  check_sound(late);
}

TEST_CASE("extremes: Newton's cradle of ten touching disks between walls, exact for fifty passes") {
  // Every number is a multiple of 1/4, so nothing is rounded: the eleventh disk flies 2, hands on
  // its velocity through ten that touch, the last flies 3 to the wall and 3 back, and so on.
  constexpr int kDisks = 11;
  constexpr double kSpeed = 0.5;
  Model<2> model = with_walls(periodic_box(16.5, 6.0), 0, kElastic);
  State<2> start;
  for (int i = 0; i < kDisks; ++i) {
    start.positions.push_back({i == 0 ? 0.5 : 2.5 + i, 3.0});
    start.velocities.push_back({i == 0 ? kSpeed : 0.0, 0.0});
  }
  // Disks at rest: 0 at 2.5 after the first pass, ..., 10 at 12.5 or under way to 16 and back.
  Simulation<2> simulation(model, start);
  for (int pass = 0; pass < 50; ++pass) {
    CAPTURE(pass);
    // Half a time unit after the pass to the right, then after the pass to the left.
    const double there = 22.0 * pass + 4.0 + 0.5;
    simulation.run_until(there);
    State<2> state = simulation.state();
    for (int i = 0; i < kDisks; ++i) {
      const bool last = i == kDisks - 1;
      REQUIRE(state.positions[i] == Vec2(2.5 + i + (last ? 0.25 : 0.0), 3.0));
      REQUIRE(state.velocities[i] == Vec2(last ? kSpeed : 0.0, 0.0));
    }
    REQUIRE(simulation.counts().disk_disk == 20U * pass + 10U);
    simulation.run_until(22.0 * pass + 4.0 + 14.0 + 0.5);
    state = simulation.state();
    for (int i = 0; i < kDisks; ++i) {
      REQUIRE(state.positions[i] == Vec2(2.5 + i - (i == 0 ? 0.25 : 0.0), 3.0));
      REQUIRE(state.velocities[i] == Vec2(i == 0 ? -kSpeed : 0.0, 0.0));
    }
    REQUIRE(simulation.counts().disk_disk == 20U * pass + 20U);
  }
  CHECK(simulation.checks().deepest_overlap == 0.0);
  CHECK(simulation.checks().clock_steps_back == 0.0);
}

TEST_CASE("extremes: powers of two scale the full model without a bit's change") {
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
}

TEST_CASE("extremes: speeds that differ by 1e12") {
  // One disk at 1e6 among others at 1e-6, which it sets in motion one after the other; and with a
  // wall that swings at a speed of order 1.
  for (const bool walled : {false, true}) {
    Model<2> model = periodic_box(9.0, 8.0);
    if (walled) {
      Wall wall = kSinusoidal;
      wall.restitution = 1.0;
      model = with_walls(with_walls(model, 0, wall), 1, kElastic);
    }
    State<2> start = clear_gas(model, 12, 907);
    for (Vec2& v : start.velocities) v *= 1e-6;
    start.velocities[5] *= 1e12;
    Simulation<2> simulation(model, start);
    const double energy = simulation.kinetic_energy();
    Reference reference(model, start);
    simulation.run_until(kNever, 300);
    reference.run_until_collisions(300);
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    simulation.run_until(kNever, 20000);
    if (!walled) CHECK(std::fabs(simulation.kinetic_energy() / energy - 1.0) < 1e-12);
    CHECK(finite_and_inside(model, simulation.state()));
    CHECK(simulation.deepest_overlap() < 1e-11);
    CHECK(simulation.checks().deepest_overlap < 1e-11);
  }
}

TEST_CASE("extremes: a wholly inelastic pile with t_c rests on every floor, and time goes on") {
  for (const Wall& kind : {kElastic, kSawtooth, kSinusoidal, kGentle}) {
    CAPTURE(static_cast<int>(kind.kind));
    Wall floor = kind;
    floor.restitution = 0.0;
    Model<2> model = periodic_box(6.0, 12.0);
    model.walls[kBottom] = floor;
    model.walls[kTop] = kElastic;
    model.restitution = 0.0;
    model.gravity = {0.0, -1.0};
    model.contact_time = 0.02;
    Simulation<2> simulation(model, clear_gas(model, 10, 908));
    for (int k = 1; k <= 40; ++k) {
      REQUIRE_NOTHROW(simulation.run_until(k));
      REQUIRE(simulation.deepest_overlap() < 1e-9);
    }
    CHECK(simulation.checks().deepest_overlap < 1e-9);
    // What t_c leaves: hops of some t_c, of speed g t_c. Sideways they slide without friction.
    double vertical = 0.0;
    for (const Vec2& v : simulation.state().velocities)
      vertical = std::max(vertical, std::fabs(v.y()));
    MESSAGE("collisions ", simulation.counts().collisions(), ", energy ",
            simulation.kinetic_energy(), ", fastest up or down ", vertical);
    if (floor.kind == WallKind::Static || floor.frequency == kGentle.frequency) {
      CHECK(vertical < 0.3);
    }
  }
}

TEST_CASE("extremes: the cascade of a bouncing ball ends when it must, and is reported") {
  // Dropped from h it lands after t_0 = sqrt(2h/g); the bounces sum to t_0 (1 + alpha)/(1 - alpha).
  for (const double restitution : {0.9, 0.5, 0.0}) {
    CAPTURE(restitution);
    Model<2> model = with_walls(periodic_box(6.0, 12.0), 1, {.restitution = restitution});
    model.gravity = {0.0, -0.5};
    State<2> start{{{3.0, 4.5}}, {{0.0, 0.0}}};
    Simulation<2> simulation(model, start);
    const std::string message = stop_of(simulation, 1e6);
    const double end = 4.0 * (1.0 + restitution) / (1.0 - restitution);
    CAPTURE(message);
    CHECK(message.find("disk 0 and the bottom wall collide without end") != std::string::npos);
    CHECK(simulation.time() == doctest::Approx(end).epsilon(1e-5));
    CHECK(simulation.state().positions[0].y() == doctest::Approx(0.5).epsilon(1e-9));
    // With the t_c that the message advises it hops on.
    model.contact_time = advised_contact_time(message);
    Simulation<2> on(model, start);
    CHECK(stop_of(on, end + 1e5 * *model.contact_time) == "");
    CHECK(on.checks().deepest_overlap < 1e-9);
  }
}

TEST_CASE("extremes: grains on floors without t_c stop cleanly or run on; with it they run on") {
  for (const Wall& kind : {kElastic, kLossy, kSawtooth, kSinusoidal, kGentle, kRoughDriven}) {
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
      CHECK(stop.find("inelastic collapse") != std::string::npos);
      model.contact_time = advised_contact_time(stop);
      MESSAGE(stop);
      Simulation<2> on(model, start);
      CHECK(stop_of(on, simulation.time() + 1000.0 * *model.contact_time) == "");
      CHECK(on.deepest_overlap() < 1e-9);
    }
  }
}

TEST_CASE("extremes: rows collapse, the message says who, and its t_c carries on") {
  // In one dimension three free disks collapse below alpha = 7 - 4 sqrt(3) = .072 (McNamara & Young
  // 1992), longer rows above.
  struct Row {
    int count;
    double restitution;
  };
  for (const Row& r : {Row{3, 0.05}, Row{12, 0.3}, Row{20, 0.5}}) {
    CAPTURE(r.count);
    Model<2> model = with_walls(periodic_box(45.0, 4.0), 0, kElastic);
    model.restitution = r.restitution;
    const State<2> start = row(r.count, 1.5);
    Simulation<2> simulation(model, start);
    const std::string message = stop_of(simulation, 1000.0);
    MESSAGE(message);
    CHECK(message.find("inelastic collapse") != std::string::npos);
    CHECK(message.find(" and disk ") != std::string::npos);
    CHECK(simulation.deepest_overlap() < 1e-11);
    model.contact_time = advised_contact_time(message);
    Simulation<2> on(model, start);
    CHECK(stop_of(on, 1000.0) == "");
    CHECK(on.time() == 1000.0);
    CHECK(on.deepest_overlap() < 1e-11);
    for (const Vec2& r_i : on.state().positions) CHECK(r_i.y() == 2.0);
  }
}

TEST_CASE("extremes: the t_c that is advised is 1e-3 of the time between collisions before") {
  // However early the collapse comes; a t_c of a thousandth of it would make grains at rest hop a
  // thousand times as often. The ball needs 100 bounces for the last 10^-4 of its time, the row has
  // some ten collisions per disk before it collapses.
  Model<2> ball = with_walls(periodic_box(6.0, 12.0), 1, {.restitution = 0.9});
  ball.gravity = {0.0, -0.5};
  Simulation<2> bouncing(ball, State<2>{{{3.0, 4.5}}, {{0.0, 0.0}}});
  const double ball_time = 1e3 * advised_contact_time(stop_of(bouncing, 1e6));
  MESSAGE("mean time of the ball ", ball_time);
  CHECK(ball_time > 0.4);  // 76 time units, the first flights 7
  CHECK(ball_time < 8.0);
  Model<2> pile = with_walls(periodic_box(6.0, 12.0), 1, {.restitution = 0.5});
  pile.restitution = 0.5;
  pile.gravity = {0.0, -1.0};
  const State<2> start = clear_gas(pile, 12, 909);
  Simulation<2> falling(pile, start), first(pile, start);
  const double pile_time = 1e3 * advised_contact_time(stop_of(falling, 1e6));
  first.run_until(kNever, 60);  // ten for each disk
  const double expected =
      first.time() * 12.0 /
      static_cast<double>(2 * first.counts().disk_disk + first.counts().disk_wall);
  MESSAGE("mean time of the pile ", pile_time, ", of its first collisions ", expected);
  CHECK(pile_time > 0.1 * expected);
  CHECK(pile_time < 10.0 * expected);
}

TEST_CASE("extremes: who looks for a standstill changes nothing") {
  // The reference does not look. Rows with a t_c far below the time of the collapse come close to
  // it; a thermal wall's restitution is not used, but makes a run be looked at.
  Model<2> model = with_walls(periodic_box(45.0, 4.0), 0, kElastic);
  model.restitution = 0.3;
  model.contact_time = 1e-9;
  const State<2> start = row(8, 1.5);
  Simulation<2> simulation(model, start);
  Reference reference(model, start);
  simulation.run_until(kNever, 8000);
  reference.run_until_collisions(8000);
  CHECK(simulation.counts().elasticised > 1000);
  CHECK(simulation.state_hash() == state_hash<2>(reference.state()));

  Model<2> plain = with_walls(periodic_box(9.0, 8.0), 0, kThermal);
  Model<2> looked_at = plain;
  looked_at.walls[kLeft]->restitution = 0.5;
  const State<2> gas = random_gas(plain, 20, 910);
  Simulation<2> a(plain, gas), b(looked_at, gas);
  a.run_until(kNever, 200000);
  b.run_until(kNever, 200000);
  CHECK(a.state_hash() == b.state_hash());
}

TEST_CASE("extremes: dense, fast and hot gases are no standstill") {
  // 2 10^5 collisions each, three times what a standstill takes: 72 inelastic disks at phi = .68,
  // kicked; between walls of T_w = 1e16 from T = 1 on; between walls that give more than they take,
  // for which inelastic disks make up.
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
    CHECK(brute_force_overlap(model, simulation.state()) < 1e-11);
    count = 30;
  }
}

TEST_CASE("extremes: one disk between walls of restitution 1.05 gains without bound and stops") {
  // v grows by 1.05 with each crossing of 9: the times sum to 9/v (1 + 1/1.05 + ...) = 21 * 9/v.
  const Wall gaining{.restitution = 1.05};
  Model<2> model = with_walls(periodic_box(10.0, 9.0), 0, gaining);
  Simulation<2> simulation(model, State<2>{{{0.5, 3.0}}, {{2.0, 0.25}}});
  const std::string message = stop_of(simulation, 1e6);
  CHECK(message.find("the temperature diverges") != std::string::npos);
  CHECK(simulation.time() == doctest::Approx(21.0 * 9.0 / 2.0).epsilon(1e-5));
  CHECK(finite_and_inside(model, simulation.state()));
  CHECK(simulation.state().velocities[0].y() == 0.25);
}
