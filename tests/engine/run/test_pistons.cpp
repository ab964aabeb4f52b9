// Strokes of the piston, the right wall, by [[change]].

#include <doctest/doctest.h>

#include <cmath>

#include "engine/error.h"
#include "engine/live/watched_run.h"
#include "engine/measure/balance.h"
#include "engine/measure/totals.h"
#include "engine/physics/theory.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/change_dimension.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/scene/refusal.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kPistonSeed = 12;

// In, out, and in again, with kicks of all particles and gravity.
const std::string kStrokes =
    "[[change]]\ntime = 1.0\npiston = 8.5\nuntil = 3.0\n"
    "[[change]]\ntime = 3.0\npiston = 11.0\nuntil = 3.5\n"
    "[[change]]\ntime = 4.25\npiston = 7.5\nuntil = 5.0\n";

std::string gas_at(const std::string& right_wall, const std::string& more = "") {
  return "box.size = [12, 10]\nparticles = { count = 40, restitution = 0.9 }\n"
         "walls.left = { kind = 'thermal', temperature = 1.0 }\nwalls.right = { " +
         right_wall + " }\ngravity.acceleration = [0.05, -0.1]\n" + more + kStrokes;
}

const char* const kWalls[] = {
    "kind = 'static'",
    "kind = 'static', restitution = 0.5, friction = 0.3",
    "kind = 'driven', drive_speed = 0.3",
    "kind = 'thermal', temperature = 0.5",
    "kind = 'sinusoidal', stroke = 0.4, frequency = 0.7",
    "kind = 'sawtooth', stroke = 0.3, frequency = 0.5, restitution = 0.7",
};

Scene compressed(const std::string& right_wall = kWalls[1]) {
  return parse_scene(gas_at(right_wall), "s.toml");
}

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

template <int D>
std::uint64_t hash_at(const Scene& scene, double time) {
  ScheduledRun<D> run(scene, kPistonSeed);
  run.run_until(time);
  return run.simulation().state_hash();
}

// Temperature of a gas that was compressed to half of its area, over that before.
double heating(double piston_speed) {
  const std::string scene =
      "box.size = [80, 20]\nparticles.count = 100\nwalls.left.kind = 'static'\n"
      "walls.right.kind = 'static'\n[[change]]\ntime = 0\npiston = 40.5\nuntil = " +
      std::to_string(39.5 / piston_speed) + "\n";
  ScheduledRun<2> run(parse_scene(scene, ""), kPistonSeed);
  run.run_until(39.5 / piston_speed + 1.0);
  return run.simulation().temperature();
}

}  // namespace

TEST_CASE("Piston: a particle leaves it at v + 2 V, in general at alpha (v + V) + v_dr + V") {
  SUBCASE("elastic, a disk") {
    check_bounces<2>({});
  }
  SUBCASE("elastic, a sphere") {
    check_bounces<3>({});
  }
  SUBCASE("with losses") {
    check_bounces<2>({.restitution = 0.75});
  }
  SUBCASE("driven") {
    check_bounces<2>({.kind = WallKind::Driven, .restitution = 0.75, .drive_speed = 0.4});
  }
  SUBCASE("without rebound it stays at the piston, until that halts") {
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
  const double slow = heating(0.02);
  double exponent = 0.0;
  constexpr int kSteps = 1000;
  for (int k = 0; k < kSteps; ++k) {
    const double length = 79.0 - 39.5 * (k + 0.5) / kSteps;
    const double fraction = packing_fraction(2, 100.0 / (20.0 * (length + 1.0)));
    exponent += compressibility(fraction, 1.0) * 39.5 / kSteps / length;
  }
  CHECK(slow == doctest::Approx(std::exp(exponent)).epsilon(0.01));
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
  for (const char* wall : kWalls) {
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

TEST_CASE("Piston: halts, a saved scene and a run continued at any event change no bit") {
  for (const char* wall : kWalls) {
    CAPTURE(wall);
    const Scene scene = compressed(wall);
    const std::uint64_t whole = hash_at<2>(scene, 6.0);
    ScheduledRun<2> again(parse_scene(scene_to_toml(scene), "again.toml"), kPistonSeed);
    again.show(scene.view);
    for (std::uint64_t steps = 1; !again.run_until(6.0, kNoLimit, steps); ++steps) {
    }
    CHECK(again.simulation().state_hash() == whole);
    REQUIRE(again.simulation().counts().strokes == 3);
    ScheduledRun<2> halted(scene, kPistonSeed);
    bool arrived = false;
    while (!arrived) {
      arrived = halted.run_until(6.0, kNoLimit, halted.simulation().counts().steps() + 37);
      ScheduledRun<2> rest(scene, kPistonSeed, halted.simulation().save());
      rest.run_until(6.0);
      CHECK(rest.simulation().state_hash() == whole);
    }
    Scene other = scene;
    other.changes.pop_back();
    CHECK(hash_at<2>(other, 6.0) != whole);
  }
}

TEST_CASE("Piston: a run saved at the time of a stroke has this stroke to come, and no other") {
  const Scene scene = compressed();
  Scene first_part = scene;
  first_part.changes.pop_back();
  first_part.changes.pop_back();
  ScheduledRun<2> before(first_part, kPistonSeed);
  before.run_until(3.0);  // the first stroke ends here, and the second begins
  ScheduledRun<2> rest(scene, kPistonSeed, before.simulation().save());
  rest.run_until(6.0);
  CHECK(rest.simulation().counts().strokes == 3);
  CHECK(rest.simulation().state_hash() == hash_at<2>(scene, 6.0));
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

TEST_CASE("Piston: time travel returns to the bits before, in and after a stroke") {
  const Scene scene = compressed();
  const auto run = watched_run(scene, kPistonSeed);
  run->run_until(6.0, kNoLimit, kNoLimit);
  for (const double time : {5.5, 0.9, 1.0, 2.0, 3.0, 3.2, 4.25, 4.5, 5.0}) {
    CAPTURE(time);
    run->go_back(time);
    while (run->time() < time) run->run_until(time, kNoLimit, run->counts().steps() + 100);
    Frame frame;
    run->fill(frame, true);
    CHECK(*frame.state_hash == hash_at<2>(scene, time));
    ScheduledRun<2> fresh(scene, kPistonSeed);
    fresh.run_until(time);
    CHECK(frame.snapshot.wall_displacement[kRight] == fresh.simulation().wall(kRight).displacement);
  }
}

TEST_CASE("Piston: tiles change no bit, of disks and of spheres") {
  const auto check = [](const auto& runs) {
    auto& [one, two] = runs;
    two->simulation().use_threads(2, TileSizes{.particles = 100, .collisions = 1.0, .halo = 4.0});
    for (const double time : {0.3, 0.6, 0.9, 1.3}) {
      one->run_until(time);
      two->run_until(time);
      CHECK(one->simulation().state_hash() == two->simulation().state_hash());
    }
    REQUIRE(two->simulation().foresight());
    CHECK(two->simulation().foresight()->work().windows > 3);
    CHECK(two->simulation().deepest_overlap() < 1e-12);
  };
  const std::string walls =
      "walls.left.kind = 'static'\nwalls.right = { kind = 'static', restitution = 0.9 }\n"
      "[[change]]\ntime = 0.4\npiston = 44\nuntil = 1.1\n";
  const Scene disks = parse_scene("box.size = [60, 60]\nparticles.count = 900\n" + walls, "");
  using Disks = ScheduledRun<2>;
  check(std::pair(std::make_unique<Disks>(disks, kPistonSeed),
                  std::make_unique<Disks>(disks, kPistonSeed)));
  const Scene spheres =
      parse_scene("box.size = [60, 10, 10]\nparticles.count = 1500\n" + walls, "");
  using Spheres = ScheduledRun<3>;
  check(std::pair(std::make_unique<Spheres>(spheres, kPistonSeed),
                  std::make_unique<Spheres>(spheres, kPistonSeed)));
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

TEST_CASE("Piston: impossible strokes are refused with their place") {
  const std::string head =
      "box.size = [12, 10]\nparticles.count = 4\n"
      "walls.left = { kind = 'sawtooth', stroke = 2.0, frequency = 0.1 }\n"
      "walls.right.kind = 'static'\n[[change]]\ntime = 1\n";  // line 7 follows
  const std::vector<std::pair<std::string, std::vector<const char*>>> wrong = {
      {"piston = 3.0\nuntil = 2", {"s.toml:7:1", "move to x = 3", "above 3, up to 12"}},
      {"piston = 12.5\nuntil = 2", {"s.toml:7:1", "move to x = 12.5"}},
      {"piston = 8.0", {"s.toml", "until"}},
      {"piston = 8.0\nuntil = 1.0", {"s.toml:8:1", "greater than 1"}},
      {"piston = 'in'\nuntil = 2", {"s.toml:7:1"}},
      {"until = 2", {"s.toml:7:1", "without a ramp or a piston"}},
      {"piston = 8.0\nuntil = 2\nset = { 'walls.left.stroke' = 1.0 }",
       {"s.toml:7:1", "[[change]] of its own"}},
      {"piston = 8.0\nuntil = 2\nnudge = { particle = 1, set = [1, 1] }",
       {"s.toml:7:1", "[[change]] of its own"}},
      {"piston = 8.0\nuntil = 3\n[[change]]\ntime = 2.5\npiston = 9\nuntil = 4",
       {"s.toml:10:1", "begin to move at t = 2.5", "until t = 3 "}},
      {"piston = 8.0\nuntil = 1.0000000000000002", {"s.toml:8:1", "speed"}},
  };
  for (const auto& [text, parts] : wrong) {
    CAPTURE(text);
    const std::string message = refusal(head + text + "\n");
    CAPTURE(message);
    for (const char* part : parts) CHECK(says(message, part));
  }
  const std::string periodic = refusal(
      "box.size = [12, 10]\nparticles.count = 4\n[[change]]\ntime = 1\npiston = 8.0\nuntil = 2\n");
  CHECK(says(periodic, "s.toml:5:1"));
  CHECK(says(periodic, "which the box lacks"));
}

TEST_CASE("Piston: a change of dimension removes strokes, and names the key") {
  const ChangedDimension changed = change_dimension(compressed(), 3);
  CHECK(changed.scene.changes.empty());
  CHECK(std::ranges::find(changed.removed, "change") != changed.removed.end());
}

TEST_CASE(
    "Piston: by hand its strokes follow each other, and a run of the scene has the same bits") {
  const std::string gas =
      "box.size = [12, 10]\nparticles = { count = 40, restitution = 0.9 }\n"
      "walls.left = { kind = 'thermal', temperature = 1.0 }\nwalls.right.kind = 'static'\n";
  const Scene scene = parse_scene(gas, "");
  for (const double at : {0.0, 1.7}) {
    CAPTURE(at);
    const auto run = watched_run(scene, kPistonSeed);
    run->run_until(at, kNoLimit, kNoLimit);
    run->move_piston(11.5, 0.25, 0.01);
    run->run_until(at + 0.1, kNoLimit, kNoLimit);
    run->move_piston(11.25, 0.25, 0.01);  // follows the first
    run->run_until(at + 2.0, kNoLimit, kNoLimit);
    run->move_piston(11.75, 0.5, 0.01);
    Frame frame;
    run->fill(frame, true);
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
      run->fill(frame, true);
      Scene saved = *frame.started;
      saved.changes = frame.scene->changes;
      ScheduledRun<2> alone(parse_scene(scene_to_toml(saved), "saved.toml"), kPistonSeed);
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
  Frame frame;
  run->fill(frame, true);
  CHECK(frame.scene->changes.size() == 3);
  run->run_until(6.0, kNoLimit, kNoLimit);
  CHECK_THROWS_AS(run->move_change(2, 2.0), UserError);
  CHECK(run->move_change(2, 5.5) == doctest::Approx(4.25));
  run->run_until(6.5, kNoLimit, kNoLimit);
  run->fill(frame, true);
  CHECK(frame.scene->changes[2].until == doctest::Approx(6.25));
  CHECK(frame.snapshot.piston_travel == 4.5);
}
