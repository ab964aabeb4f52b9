// Strokes of the piston, the right wall, by [[change]].

#include <doctest/doctest.h>

#include <cmath>

#include "engine/error.h"
#include "engine/measure/balance.h"
#include "engine/measure/totals.h"
#include "engine/physics/theory.h"
#include "tests/engine/run/acts.h"
#include "tests/engine/support/gas.h"
#include "tests/support/messages.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kPistonSeed = 12;

// A disk or sphere that flies along x between the left wall and the piston.
template <int D>
struct Bouncer {
  Model<D> model;
  State<D> state;
};

template <int D>
Bouncer<D> bouncer(double speed, const Wall& right) {
  Bouncer<D> one;
  one.model.box = Vec<D>::Constant(20.0);
  one.model.walls[kLeft] = Wall{};
  one.model.walls[kRight] = right;
  one.state.positions.push_back(Vec<D>::Constant(7.0));
  one.state.velocities.push_back(speed * Vec<D>::Unit(0));
  return one;
}

// The velocities after each hit of the right wall.
template <int D>
class RightHits : public Observer<D> {
 public:
  void on_wall(const WallCollision<D>& hit) override {
    if (hit.side != kRight) return;
    speeds.push_back((hit.particle.velocity + hit.particle.gain.momentum)[0]);
    times.push_back(hit.time);
  }
  std::vector<double> speeds, times;
};

// By hand: the disk meets the piston at x = 19.5 - V t, and then flies to the left wall and back.
template <int D>
void check_bounces(const Wall& right) {
  const double piston = 0.5, speed = 3.0;
  const auto [model, state] = bouncer<D>(speed, right);
  Simulation<D> run(model, state);
  RightHits<D> hits;
  run.add_observer(hits);
  run.run_until(0.0);
  run.move_piston(5.0, 0.0, 30.0);
  run.run_until(20.0);
  double time = 0.0, place = 7.0, v = speed;
  std::size_t hit = 0;
  while (true) {
    const double contact = time + (19.5 - piston * time - place) / (v + piston);
    if (contact > 20.0) break;
    REQUIRE(hit < hits.times.size());
    const double after = right.restitution * (v + piston) + right.drive_speed + piston;
    CHECK(hits.speeds[hit] == doctest::Approx(-after).epsilon(1e-13));
    time = contact + (19.5 - piston * contact - 0.5) / after;
    place = 0.5;
    v = after;
    ++hit;
  }
  CHECK(hits.times.size() == hit);
  CHECK(hit > 2);
  if (time < 20.0) {
    CHECK(run.state().positions[0][0] == doctest::Approx(place + v * (20.0 - time)).epsilon(1e-12));
  }
  CHECK(run.wall(kRight).displacement == doctest::Approx(10.0).epsilon(1e-14));
  CHECK(run.wall(kRight).velocity == piston);
  CHECK(run.checks().deepest_overlap < 1e-14);
}

}  // namespace

TEST_CASE("Piston: a particle leaves it at v + 2 V, in general at alpha (v + V) + v_dr + V") {
  check_bounces<2>({});
  check_bounces<3>({});
  check_bounces<2>({.restitution = 0.75});
  check_bounces<2>({.kind = WallKind::Driven, .restitution = 0.75, .drive_speed = 0.4});
}

TEST_CASE("Piston: without rebound a particle stays at it, until it halts") {
  for (const Wall& right :
       {Wall{.restitution = 0.0}, Wall{.kind = WallKind::Thermal, .temperature = 0.0}}) {
    const auto [model, state] = bouncer<2>(3.0, right);
    Simulation<2> run(model, state);
    run.run_until(0.0);
    run.move_piston(10.0, 0.0, 20.0);
    run.run_until(19.0);
    CHECK(run.counts().wall_collisions == 1);
    CHECK(run.state().positions[0][0] == doctest::Approx(19.5 - 9.5).epsilon(1e-14));
    run.run_until(30.0);
    // It leaves at the piston's speed, and hits the left wall at x = 0.5.
    CHECK(run.state().positions[0][0] == doctest::Approx(9.5 - 5.0).epsilon(1e-13));
  }
}

TEST_CASE("Piston: a particle that the piston overtakes under gravity is hit at the piston") {
  // The disk flies inwards at 1 and falls back towards the right wall; the piston moves in at 2.
  auto [model, state] = bouncer<2>(-1.0, {});
  state.positions[0][0] = 15.0;
  model.gravity = Vec2(0.5, 0.0);
  Simulation<2> run(model, state);
  RightHits<2> hits;
  run.add_observer(hits);
  run.run_until(1.0);
  run.move_piston(10.0, 1.0, 6.0);
  run.run_until(4.0);
  // 15 - t + t^2/4 = 19.5 - 2 (t - 1): the root of t^2/4 + t - 6.5 = 0.
  const double contact = 2.0 * (std::sqrt(7.5) - 1.0);
  REQUIRE(!hits.times.empty());
  const double before = -1.0 + 0.5 * contact;
  CHECK(hits.speeds[0] == doctest::Approx(-4.0 - before).epsilon(1e-13));
  // The base moved at t = 1.
  CHECK(hits.times[0] == doctest::Approx(contact - 1.0).epsilon(1e-13));
}

// A dilute gas in slow compression has dT/T = -Z dA/A (theory 6.3). Between hits of walls the
// centres are in a box that is shorter by a diameter.
TEST_CASE("Piston: slow compression heats the gas as 1/A") {
  const Scene scene = parse_scene(
      "box.size = [80, 20]\nparticles.count = 100\nwalls.left.kind = 'static'\n"
      "walls.right.kind = 'static'\n[[change]]\ntime = 0\npiston = 40.5\nuntil = 1975\n",
      "");
  ScheduledRun<2> run(scene, kPistonSeed);
  run.run_until(1976.0);
  double exponent = 0.0;
  constexpr int kSteps = 1000;
  for (int k = 0; k < kSteps; ++k) {
    const double length = 79.0 - 39.5 * (k + 0.5) / kSteps;
    const double fraction = packing_fraction(2, 100.0 / (20.0 * (length + 1.0)));
    exponent += compressibility(fraction, 1.0) * 39.5 / kSteps / length;
  }
  CHECK(run.simulation().temperature() == doctest::Approx(std::exp(exponent)).epsilon(0.01));
}

TEST_CASE("Piston: an elastic gas compressed and released slowly has its temperature again") {
  const Scene scene = parse_scene(
      "box.size = [40, 20]\nparticles.count = 100\nwalls.left.kind = 'static'\n"
      "walls.right.kind = 'static'\n[[change]]\ntime = 0\npiston = 20\nuntil = 1000\n"
      "[[change]]\ntime = 1000\npiston = 40\nuntil = 2000\n",
      "");
  ScheduledRun<2> run(scene, kPistonSeed);
  run.run_until(1000.0);
  CHECK(run.simulation().temperature() > 1.9);
  run.run_until(2000.0);
  CHECK(run.simulation().temperature() == doctest::Approx(1.0).epsilon(0.02));
  CHECK(run.simulation().wall(kRight).displacement == 0.0);
}

TEST_CASE("Piston: nothing passes it, and ledger and balances close, with walls of all kinds") {
  for (const std::string& wall : kPistons) {
    CAPTURE(wall);
    ScheduledRun<2> run(compressed(wall), kPistonSeed);
    Totals<2> totals(run.simulation());
    Balance<2> balance(run.simulation(), IntVec<2>(4, 3));
    run.simulation().add_observer(totals);
    run.simulation().add_observer(balance);
    for (double time = 0.05; time < 6.0; time += 0.05) {
      run.run_until(time);
      // The wall by hand, and the centres of all disks.
      const double place = time < 1.0    ? 12.0
                           : time < 3.0  ? 12.0 - 1.75 * (time - 1.0)
                           : time < 3.5  ? 8.5 + 5.0 * (time - 3.0)
                           : time < 4.25 ? 11.0
                           : time < 5.0  ? 11.0 - 14.0 / 3.0 * (time - 4.25)
                                         : 7.5;
      const Simulation<2>& gas = run.simulation();
      const double travel = gas.wall(kRight).displacement;
      if (!gas.model().walls[kRight]->moves()) CHECK(12.0 - travel == doctest::Approx(place));
      double farthest = 0.0;
      for (const Vec2& r : gas.positions()) farthest = std::max(farthest, r.x());
      CHECK(farthest < 11.5 - travel + 1e-12);
      CHECK(gas.deepest_overlap() < 1e-12);
    }
    check_sound(run.simulation());
    CHECK(run.simulation().counts().strokes == 3);
    CHECK(totals.ledger_residual() < 1e-12);
    CHECK(balance.close_window().imbalances.largest().maxCoeff() < 1e-9);
    // The piston compresses the gas, so walls give it energy.
    CHECK(totals.close_window().walls_in > 1.0);
  }
}

TEST_CASE("Piston: a change of laws during the stroke does not halt it") {
  Scene scene = compressed();
  scene.changes.push_back({.time = 2.0, .set = {{"walls.right.restitution", "0.9"}}});
  ScheduledRun<2> run(scene, kPistonSeed);
  run.run_until(2.5);
  CHECK(run.simulation().wall(kRight).displacement == doctest::Approx(1.5 * 1.75));
  CHECK(run.simulation().wall(kRight).velocity == 1.75);
  run.run_until(6.0);
  CHECK(run.simulation().wall(kRight).displacement == 4.5);
  CHECK(run.simulation().deepest_overlap() < 1e-12);
}

// 9 disks at close packing have 2.6 by 3, which the piston reaches at t = 4.4.
TEST_CASE("Piston: a gas without room stops, with and without losses, and with a contact time") {
  const auto stop = [](const std::string& more) {
    ScheduledRun<2> run(
        parse_scene("box.size = [6, 3]\nparticles.count = 9\nwalls.left.kind = 'static'\n"
                    "walls.right.kind = 'static'\n" +
                        more + "[[change]]\ntime = 1\npiston = 2\nuntil = 5\n",
                    ""),
        kPistonSeed);
    std::string message;
    try {
      run.run_until(20.0);
    } catch (const PhysicalStop& physical) {
      message = physical.what();
    }
    CHECK(run.simulation().time() > 3.0);
    CHECK(run.simulation().time() < 4.4);
    CHECK(std::isfinite(run.simulation().kinetic_energy()));
    return message;
  };
  CHECK(says(stop(""), "the piston leaves the particles no room"));
  CHECK(says(stop("particles.restitution = 0.9\n"), "while the piston compresses the gas"));
  CHECK(says(stop("particles.restitution = 0.9\ncollapse.contact_time = 0.1\n"),
             "the piston leaves the particles no room"));
}

// The kicks heat the gas, which starts at rest, to a thousand times the speed of one kick.
TEST_CASE("Piston: after a stroke no speed is a sign of a gas without room") {
  const Scene scene = parse_scene(
      "box.size = [20, 10]\nparticles = { count = 4, start = { temperature = 0 } }\n"
      "walls.left.kind = 'static'\nwalls.right.kind = 'static'\n"
      "bulk_drive = { interval = 1e-4, kick_speed = 1e-3 }\n"
      "[[change]]\ntime = 0\npiston = 19.9999\nuntil = 1.0\n",
      "");
  ScheduledRun<2> run(scene, kPistonSeed);
  CHECK_NOTHROW(run.run_until(200.0));
  CHECK(run.simulation().temperature() > 1.0);
}

TEST_CASE(
    "Piston: by hand its strokes follow each other, and a run of the scene has the same bits") {
  const Scene scene = parse_scene(with_piston("kind = 'static'"), "");
  for (const double at : {0.0, 1.7}) {
    CAPTURE(at);
    const auto run = watched_run(scene, kPistonSeed);
    run->run_until(at, kNoLimit, kNoLimit);
    run->move_piston(11.5, 0.25, 0.01);
    run->run_until(at + 0.1, kNoLimit, kNoLimit);
    run->move_piston(11.25, 0.25, 0.01);  // follows the first
    run->run_until(at + 2.0, kNoLimit, kNoLimit);
    run->move_piston(11.75, 0.5, 0.01);
    Frame frame = filled_frame(*run);
    const std::vector<Change> strokes = frame.scene->changes;
    REQUIRE(strokes.size() == 3);
    CHECK(strokes[0].time > 0.0);
    CHECK(strokes[0].time >= at);
    CHECK(strokes[0].time <= at + 0.01);
    CHECK(strokes[1].time == strokes[0].until);
    CHECK(strokes[2].time >= at + 2.0);
    CHECK(strokes[2].time <= at + 2.01);
    const auto check_at = [&](double time) {
      CAPTURE(time);
      while (run->time() < time) run->run_until(time, kNoLimit, kNoLimit);
      frame = filled_frame(*run);
      ScheduledRun<2> alone(saved_scene(frame), kPistonSeed);
      alone.run_until(run->time());
      CHECK(alone.simulation().state_hash() == *frame.state_hash);
      CHECK(frame.snapshot.wall_displacement[kRight] ==
            alone.simulation().wall(kRight).displacement);
      CHECK(frame.snapshot.piston_travel ==
            doctest::Approx(frame.snapshot.wall_displacement[kRight]).epsilon(1e-13));
    };
    check_at(run->time());
    check_at(4.5);
    CHECK(frame.snapshot.piston_travel == 0.25);
    for (const double time : {at + 0.2, at + 0.3, at + 1.0}) {
      run->go_back(time);
      check_at(time);
    }
    // Without the last two strokes.
    const std::vector<Change> first(strokes.begin(), strokes.begin() + 1);
    run->replace_changes(first, strokes[1].time);
    check_at(5.0);
    CHECK(frame.snapshot.piston_travel == 0.5);
  }
}

TEST_CASE("Piston: by hand and in a moved change strokes do not overlap") {
  const auto run = watched_run(compressed(), kPistonSeed);
  run->run_until(0.95, kNoLimit, kNoLimit);
  CHECK_THROWS_AS(run->move_piston(11.0, 0.1, 0.0), UserError);
  CHECK_THROWS_AS(run->move_piston(13.0, 0.01, 0.0), UserError);
  CHECK(filled_frame(*run).scene->changes.size() == 3);
  run->run_until(6.0, kNoLimit, kNoLimit);
  CHECK_THROWS_AS(run->move_change(2, 2.0), UserError);
  CHECK(run->move_change(2, 5.5) == doctest::Approx(4.25));
  run->run_until(6.5, kNoLimit, kNoLimit);
  const Frame frame = filled_frame(*run);
  CHECK(frame.scene->changes[2].until == doctest::Approx(6.25));
  CHECK(frame.snapshot.piston_travel == 4.5);
}
