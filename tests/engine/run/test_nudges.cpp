// Nudges: changes of velocities by [[change]].

#include <doctest/doctest.h>

#include <cmath>

#include "engine/error.h"
#include "engine/live/watched_run.h"
#include "engine/measure/balance.h"
#include "engine/measure/totals.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/change_dimension.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/schedule.h"
#include "tests/engine/scene/refusal.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kNudgeSeed = 21;

const std::string kDisks =
    "box.size = [12, 10]\nparticles = { count = 40, restitution = 0.9 }\n"
    "walls.left = { kind = 'driven', drive_speed = 0.3 }\nwalls.right = { kind = 'static' }\n"
    "gravity.acceleration = [0.0, -0.1]\nbulk_drive = { interval = 0.5, kick_speed = 0.05 }\n";

// At t = 2 a kick of the bulk drive comes before the change of laws and its nudge.
const std::string kChanges =
    "[[change]]\ntime = 2.0\nset = { 'particles.restitution' = 0.8 }\n"
    "nudge = { centre = [11.5, 0.5], radius = 3.0, scale = 2.0 }\n"
    "[[change]]\ntime = 3.3\nnudge = { centre = [4.0, 5.0], radius = 2.5, add = [1.0, 0.5] }\n"
    "[[change]]\ntime = 3.3\nnudge = { particle = 17, set = [-3.0, 1.0] }\n";

Scene nudged() {
  return parse_scene(kDisks + kChanges, "s.toml");
}

// The hash at a time of a run of the scene that a frame would save.
std::uint64_t hash_of_scene(const Frame& frame, double time) {
  Scene scene = *frame.started;
  scene.changes = frame.scene->changes;
  ScheduledRun<2> alone(parse_scene(scene_to_toml(scene), "saved.toml"), kNudgeSeed);
  alone.run_until(time);
  return alone.simulation().state_hash();
}

// A gas whose particles fly freely until the nudge at t = 1.
template <int D>
State<D> velocities_after(const std::string& nudge, State<D>& before) {
  const std::string box = D == 2 ? "[20, 20]" : "[20, 20, 20]";
  const std::string gas = "box.size = " + box + "\nparticles.count = 30\n";
  ScheduledRun<D> plain(parse_scene(gas, ""), kNudgeSeed);
  ScheduledRun<D> run(parse_scene(gas + "[[change]]\ntime = 1\nnudge = " + nudge + "\n", ""),
                      kNudgeSeed);
  plain.run_until(1.0);
  run.run_until(1.0);
  before = plain.simulation().state();
  return run.simulation().state();
}

// Distance to a point in a periodic box of 20.
template <int D>
double distance(const Vec<D>& position, const Vec<D>& centre) {
  double square = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    double way = std::fabs(position[axis] - centre[axis]);
    way = std::min(way, 20.0 - way);
    square += way * way;
  }
  return std::sqrt(square);
}

template <int D>
void check_scaling(const std::string& centre, const Vec<D>& place) {
  State<D> before;
  const State<D> after =
      velocities_after<D>("{ centre = " + centre + ", radius = 7.0, scale = 1.5 }", before);
  Vec<D> mean = Vec<D>::Zero();
  int inside = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    if (distance<D>(before.positions[i], place) > 7.0) continue;
    mean += before.velocities[i];
    ++inside;
  }
  REQUIRE(inside > 1);
  REQUIRE(inside < 30);
  mean /= inside;
  for (std::size_t i = 0; i < 30; ++i) {
    const bool changes = distance<D>(before.positions[i], place) <= 7.0;
    const Vec<D> expected =
        changes ? Vec<D>(mean + 1.5 * (before.velocities[i] - mean)) : before.velocities[i];
    CHECK((after.velocities[i] - expected).norm() < 1e-12);
    CHECK((after.positions[i] - before.positions[i]).norm() < 1e-12);
  }
}

}  // namespace

TEST_CASE("Nudge: scale heats a region about its mean velocity, across periodic sides") {
  SUBCASE("disks") {
    check_scaling<2>("[19.0, 1.0]", Vec2(19.0, 1.0));
  }
  SUBCASE("spheres") {
    check_scaling<3>("[19.0, 1.0, 10.0]", Vec<3>(19.0, 1.0, 10.0));
  }
}

TEST_CASE("Nudge: add and set give their velocities") {
  State<2> before;
  const State<2> added =
      velocities_after<2>("{ centre = [10.0, 10.0], radius = 100.0, add = [0.5, -2.0] }", before);
  const State<2> set = velocities_after<2>("{ particle = 17, set = [3.0, 0.25] }", before);
  for (std::size_t i = 0; i < 30; ++i) {
    CHECK((added.velocities[i] - before.velocities[i] - Vec2(0.5, -2.0)).norm() < 1e-12);
    CHECK(set.velocities[i] == (i == 17 ? Vec2(3.0, 0.25) : before.velocities[i]));
  }
}

// Particles have mass 1.
TEST_CASE("Nudge: add gives a region the momentum of its particles, and set that of the velocity") {
  State<2> before;
  const Vec2 centre(19.0, 4.0), speed(0.5, -2.0);
  const State<2> added =
      velocities_after<2>("{ centre = [19.0, 4.0], radius = 6.0, add = [0.5, -2.0] }", before);
  const auto momentum = [](const State<2>& state) {
    Vec2 sum = Vec2::Zero();
    for (const Vec2& velocity : state.velocities) sum += velocity;
    return sum;
  };
  const auto inside = std::ranges::count_if(
      before.positions, [&](const Vec2& place) { return distance<2>(place, centre) <= 6.0; });
  REQUIRE(inside > 1);
  REQUIRE(inside < 30);
  const Vec2 gained = momentum(added) - momentum(before);
  CHECK((gained - static_cast<double>(inside) * speed).norm() < 1e-12);

  const State<2> set =
      velocities_after<2>("{ centre = [19.0, 4.0], radius = 6.0, set = [0.5, -2.0] }", before);
  CHECK(std::ranges::count(set.velocities, speed) == inside);
}

TEST_CASE("Nudge: the ledger and all balances stay closed, and its energy has its own sum") {
  const Scene scene = nudged();
  ScheduledRun<2> run(scene, kNudgeSeed);
  run.run_until(2.5);
  Totals<2> totals(run.simulation());
  Balance<2> balance(run.simulation(), IntVec<2>(4, 3));
  run.simulation().add_observer(totals);
  run.simulation().add_observer(balance);
  run.run_until(std::nextafter(3.3, 0.0));
  const double energy = run.simulation().kinetic_energy();
  run.run_until(3.3);
  const double gained = run.simulation().kinetic_energy() - energy;
  REQUIRE(std::fabs(gained) > 1.0);
  run.run_until(5.0);
  CHECK(totals.close_window().nudges_in == doctest::Approx(gained).epsilon(1e-9));
  CHECK(totals.ledger_residual() < 1e-12);
  CHECK(balance.close_window().imbalances.largest().maxCoeff() < 1e-9);
}

TEST_CASE("Nudge: halts, a saved scene and a run continued at any event change no bit") {
  const Scene scene = nudged();
  ScheduledRun<2> whole(scene, kNudgeSeed);
  whole.run_until(6.0);
  ScheduledRun<2> again(parse_scene(scene_to_toml(scene), "again.toml"), kNudgeSeed);
  again.show(scene.view);
  for (std::uint64_t steps = 1; !again.run_until(6.0, kNoLimit, steps); ++steps) {
  }
  CHECK(again.simulation().state_hash() == whole.simulation().state_hash());
  REQUIRE(whole.simulation().counts().nudges == 3);

  ScheduledRun<2> halted(scene, kNudgeSeed);
  bool arrived = false;
  while (!arrived) {
    arrived = halted.run_until(6.0, kNoLimit, halted.simulation().counts().steps() + 7);
    ScheduledRun<2> rest(scene, kNudgeSeed, halted.simulation().save());
    rest.run_until(6.0);
    CHECK(rest.simulation().state_hash() == whole.simulation().state_hash());
  }
  Scene other = scene;
  other.changes.pop_back();
  ScheduledRun<2> without(other, kNudgeSeed);
  without.run_until(6.0);
  CHECK(without.simulation().state_hash() != whole.simulation().state_hash());
}

TEST_CASE(
    "Nudge: a run saved between a kick and the nudge of the same time has the nudge to come") {
  const Scene scene = nudged();
  Scene first_part = scene;
  first_part.changes.clear();
  ScheduledRun<2> before(first_part, kNudgeSeed);
  before.run_until(2.0);
  ScheduledRun<2> rest(scene, kNudgeSeed, before.simulation().save()), whole(scene, kNudgeSeed);
  rest.run_until(6.0);
  whole.run_until(6.0);
  CHECK(rest.simulation().state_hash() == whole.simulation().state_hash());
}

TEST_CASE("Nudge: time travel returns to the bits before and after it") {
  const Scene scene = nudged();
  const auto run = watched_run(scene, kNudgeSeed);
  const auto hash_at = [&](double time) {
    run->go_back(time);
    while (run->time() < time) run->run_until(time, kNoLimit, run->counts().steps() + 100);
    Frame frame;
    run->fill(frame, true);
    return *frame.state_hash;
  };
  run->run_until(6.0, kNoLimit, kNoLimit);
  for (const double time : {5.0, 1.9, 2.0, 3.3, 3.2, 0.5, 4.4}) {
    ScheduledRun<2> fresh(scene, kNudgeSeed);
    fresh.run_until(time);
    CHECK(hash_at(time) == fresh.simulation().state_hash());
  }
}

TEST_CASE("Nudge: tiles change no bit") {
  const std::string gas =
      "box.size = [60, 60]\nparticles.count = 900\n"
      "[[change]]\ntime = 0.4\nnudge = { centre = [30.0, 30.0], radius = 8.0, scale = 3.0 }\n";
  const Scene scene = parse_scene(gas, "");
  ScheduledRun<2> one(scene, kNudgeSeed), two(scene, kNudgeSeed);
  two.simulation().use_threads(2, TileSizes{.particles = 100, .collisions = 1.0, .halo = 4.0});
  one.run_until(1.5);
  two.run_until(0.4);
  REQUIRE(two.simulation().foresight());
  CHECK(two.simulation().tiles() > 1);
  const std::uint64_t windows = two.simulation().foresight()->work().windows;
  CHECK(windows > 0);
  two.run_until(1.5);
  CHECK(two.simulation().foresight()->work().windows > windows);
  CHECK(one.simulation().state_hash() == two.simulation().state_hash());
}

TEST_CASE("Nudge: a velocity beyond the largest stops the run, and the state remains") {
  std::string text = kDisks;
  for (int i = 0; i < 8; ++i) {
    text += "[[change]]\ntime = 1\nnudge = { centre = [6, 5], radius = 9, scale = 1000 }\n";
  }
  ScheduledRun<2> run(parse_scene(text, ""), kNudgeSeed);
  CHECK_THROWS_AS(run.run_until(2.0), PhysicalStop);
  CHECK(run.simulation().counts().nudges < 8);
  CHECK(std::isfinite(run.simulation().kinetic_energy()));

  // A speed that rounds to the largest.
  ScheduledRun<2> thrown(
      parse_scene(kDisks + "[[change]]\ntime = 1\nnudge = { particle = 3, set = [1e15, 1e9] }\n",
                  ""),
      kNudgeSeed);
  CHECK_THROWS_WITH_AS(thrown.run_until(2.0),
                       "a nudge gives particle 3 a speed above 1e+15; make it weaker",
                       PhysicalStop);
}

// A gas without losses between driven walls stops at a million times its fastest speed.
TEST_CASE("Nudge: a particle may be thrown faster than walls could drive it") {
  const Scene scene = parse_scene(
      "box.size = [12, 10]\nparticles.count = 20\n"
      "walls.left = { kind = 'driven', drive_speed = 1.0 }\nwalls.right = { kind = 'static' }\n"
      "[[change]]\ntime = 1.0\nnudge = { particle = 3, set = [-1e8, 0.0] }\n",
      "");
  ScheduledRun<2> run(scene, kNudgeSeed);
  run.run_until(1.0);
  ScheduledRun<2> resumed(scene, kNudgeSeed, run.simulation().save());
  for (ScheduledRun<2>* thrown : {&run, &resumed}) {
    const std::uint64_t before = thrown->simulation().counts().wall_collisions;
    CHECK_NOTHROW(thrown->run_until(1.0 + 1e-6));
    CHECK(thrown->simulation().counts().wall_collisions > before);
  }
}

TEST_CASE("Nudge: by hand it is recorded at its time, and a run of its scene has the same bits") {
  const Scene scene = parse_scene(kDisks, "");
  for (const double at : {0.0, 1.7, 4.0}) {
    CAPTURE(at);
    const auto run = watched_run(scene, kNudgeSeed);
    run->run_until(at, kNoLimit, kNoLimit);
    const Nudge heat{.centre = Vec2(6.0, 5.0), .radius = 3.0, .scale = 1.5};
    run->nudge(heat, 0.01);
    run->nudge({.particle = 7, .add = Vec2(0.0, 2.0)}, 0.0);
    Frame frame;
    run->fill(frame, true);
    REQUIRE(frame.scene->changes.size() == 2);
    const auto& [first, second] = std::tie(frame.scene->changes[0], frame.scene->changes[1]);
    CHECK(first.nudge == heat);
    CHECK(first.time > 0.0);
    CHECK(first.time >= at);
    CHECK(first.time <= at + 0.01);
    CHECK(second.time == doctest::Approx(first.time).epsilon(1e-14));
    CHECK(hash_of_scene(frame, run->time()) == *frame.state_hash);
    run->run_until(6.0, kNoLimit, kNoLimit);
    run->fill(frame, true);
    CHECK(frame.tally.nudges_in > 0.0);
    CHECK(hash_of_scene(frame, 6.0) == *frame.state_hash);
    // The record has the states at the nudges.
    for (const double time : {5.0, at + 0.02, 0.5 * at}) {
      run->go_back(time);
      run->run_until(time, kNoLimit, kNoLimit);
      run->fill(frame, true);
      CHECK(hash_of_scene(frame, time) == *frame.state_hash);
    }
  }
}

TEST_CASE("Nudge: by hand an impossible one is refused, and the future stays") {
  const auto run = watched_run(parse_scene(kDisks, ""), kNudgeSeed);
  run->run_until(4.0, kNoLimit, kNoLimit);
  run->go_back(2.0);
  run->run_until(2.0, kNoLimit, kNoLimit);
  CHECK_THROWS_AS(run->nudge({.particle = 40, .set = Vec2(1.0, 0.0)}, 0.0), UserError);
  CHECK_THROWS_AS(run->nudge({.particle = 4, .set = Vec2(1e16, 0.0)}, 0.0), PhysicalStop);
  Frame frame;
  run->fill(frame, true);
  CHECK(frame.head == doctest::Approx(4.0));
  CHECK(frame.scene->changes.empty());
  CHECK_FALSE(frame.other_future);
}

TEST_CASE("Nudge: removed from a run it leaves the bits of the others, and its future remains") {
  const Scene scene = parse_scene(kDisks, "");
  const auto run = watched_run(scene, kNudgeSeed);
  const auto tell = [&] {
    Frame frame;
    run->fill(frame, true);
    return frame;
  };
  const auto run_to = [&](double time) {
    run->run_until(time, kNoLimit, kNoLimit);
    return *tell().state_hash;
  };
  const auto fresh = [&](const std::vector<Change>& changes, double time) {
    Scene with = scene;
    with.changes = changes;
    ScheduledRun<2> alone(with, kNudgeSeed);
    alone.run_until(time);
    return alone.simulation().state_hash();
  };
  // Three equal nudges, two of them at one time.
  const Nudge heat{.centre = Vec2(6.0, 5.0), .radius = 3.0, .scale = 1.5};
  run->run_until(1.0, kNoLimit, kNoLimit);
  run->nudge(heat, 0.0);
  run->run_until(2.0, kNoLimit, kNoLimit);
  run->nudge(heat, 0.0);
  run->nudge(heat, 0.0);
  run->run_until(5.0, kNoLimit, kNoLimit);
  const std::vector<Change> three = tell().scene->changes;
  REQUIRE(three.size() == 3);
  const std::vector<Change> two(three.begin(), three.end() - 1);
  const double from = run->replace_changes(two, three.back().time);
  CHECK(from == three.back().time);
  run_to(from);
  CHECK(run->head() == doctest::Approx(2.0));
  CHECK(tell().scene->changes == two);
  CHECK(run_to(6.0) == fresh(two, 6.0));
  REQUIRE(tell().other_future);
  run_to(run->exchange_futures());
  CHECK(tell().scene->changes == three);
  CHECK(run_to(6.0) == fresh(three, 6.0));
  CHECK_THROWS_AS(run->replace_changes({}, 0.0), UserError);
  CHECK(run_to(7.0) == fresh(three, 7.0));
}

TEST_CASE("Nudge: impossible nudges are refused with their place") {
  const std::string head = kDisks + "[[change]]\ntime = 1\n";  // line 9 follows
  const std::vector<std::pair<std::string, std::vector<const char*>>> wrong = {
      {"nudge = { centre = [13, 5], radius = 1, scale = 2 }",
       {"s.toml:9:11", "outside of the box"}},
      {"nudge = { centre = [3, 5, 1], radius = 1, scale = 2 }", {"s.toml:9:11", "3 numbers"}},
      {"nudge = { centre = [3, 5], radius = 0, scale = 2 }", {"s.toml:9:28", "greater than 0"}},
      {"nudge = { centre = [3, 5], scale = 2 }", {"s.toml:9", "no radius"}},
      {"nudge = { centre = [nan, 5], radius = 1, scale = 2 }", {"s.toml:9:11", "cannot be"}},
      {"nudge = { centre = [3, 5], radius = 1, add = [inf, 0] }", {"s.toml:9:40", "cannot be"}},
      {"nudge = { centre = [3, 5], radius = 1 }", {"s.toml:9", "changes no velocity"}},
      {"nudge = { scale = 2 }", {"s.toml:9", "no particles"}},
      {"nudge = { particle = 40, set = [1, 1] }", {"s.toml:9:11", "no particle 40", "0 to 39"}},
      {"nudge = { particle = 4, scale = 2 }", {"s.toml:9:25", "one particle"}},
      {"nudge = { particle = 4, add = [1, 1], set = [1, 1] }", {"s.toml:9:39", "one of scale"}},
      {"nudge = { particle = 4, set = [1, 1] }\nset = { 'particles.restitution' = 0.5 }\n"
       "ramp = 'linear'\nuntil = 4",
       {"s.toml:11:1", "a nudge has no ramp"}},
      {"nudge = { particel = 4, set = [1, 1] }", {"s.toml:9:11", "'particle'"}},
  };
  for (const auto& [text, parts] : wrong) {
    CAPTURE(text);
    const std::string message = refusal(head + text + "\n");
    CAPTURE(message);
    for (const char* part : parts) CHECK(says(message, part));
  }
}

TEST_CASE("Nudge: a change of dimension removes nudges, and names the key") {
  const ChangedDimension changed = change_dimension(nudged(), 3);
  REQUIRE(changed.scene.changes.size() == 1);
  CHECK_FALSE(changed.scene.changes[0].nudge);
  CHECK(std::ranges::find(changed.removed, "change") != changed.removed.end());
}
