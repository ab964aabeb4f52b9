#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/physics/collision.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"

using namespace clatter;
using namespace clatter::testing;

// Where numbers are few, huge, tiny or equal: nothing may hang, overlap or depend on the units.

namespace {

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

}  // namespace

TEST_CASE("extremes: no, one and two disks between walls of every kind come to the end") {
  const std::optional<Wall> walls[] = {std::nullopt, kStatic,   kLossy,      kDriven,
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
        if (stop.empty()) {
          CHECK(simulation.time() == 50.0);
          CHECK(simulation.counts().kicks == (features & 2 ? 166 : 0));
        }
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
  Model<2> model = with_walls(periodic_box(16.5, 6.0), 0, kStatic);
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

// The first disks reach the walls late after the start and leave them fast: times there are rounded
// by as much as these disks fly in 1e-10 diameters' time, unless the base moves.
TEST_CASE("extremes: a cold gas between driven walls overlaps by rounding only") {
  for (const double speed : {1e-4, 1e-8, 1e-12}) {
    CAPTURE(speed);
    Model<2> model = with_walls(periodic_box(20.0, 25.0), 0, kDriven);
    model.restitution = 0.9;
    State<2> start = random_gas(model, 100, 912);
    for (Vec2& v : start.velocities) v *= speed;
    Simulation<2> simulation(model, start);
    Reference reference(model, start);
    simulation.run_until(kNever, 100);
    reference.run_until_collisions(100);
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    simulation.run_until(kNever, 20000);
    check_sound(simulation);
  }
}

TEST_CASE("extremes: speeds that differ by 1e12") {
  // One disk at 1e6 among others at 1e-6, which it sets in motion one after the other; and with a
  // wall that swings at a speed of order 1.
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
