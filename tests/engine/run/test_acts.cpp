// What nudges, strokes of the piston and puffs have in common: they change the state of a run.

#include <doctest/doctest.h>

#include <array>

#include "engine/error.h"
#include "engine/scene/change_dimension.h"
#include "tests/engine/run/acts.h"
#include "tests/engine/scene/refusal.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

struct Act {
  std::string name;
  Scene scene;
  std::uint64_t acts;
  std::size_t other_changes = 0;
};

std::vector<Act> all_acts() {
  std::vector<Act> acts = {{"nudges", nudged(), 3, 1}, {"puffs", puffed(), 4, 1}};
  for (const std::string& wall : kPistons) acts.push_back({wall, compressed(wall), 3});
  return acts;
}

// The new particles of a puff need new tiles.
template <int D>
void check_tiles(const std::string& text) {
  CAPTURE(text);
  const Scene scene = parse_scene(text, "");
  const TileSizes sizes{.particles = 100, .collisions = 1.0, .halo = 4.0};
  ScheduledRun<D> one(scene, kActSeed), two(scene, kActSeed);
  two.simulation().use_threads(2, sizes);
  const auto windows = [&] { return two.simulation().foresight()->work().windows; };
  const Change& change = scene.changes.front();
  std::uint64_t before = 0;
  for (const double time : {0.3, 0.4, 0.9, 1.5}) {
    one.run_until(time);
    two.run_until(time);
    CHECK(one.simulation().state_hash() == two.simulation().state_hash());
    CHECK(two.simulation().deepest_overlap() < 1e-12);
    if (time < 0.4) CHECK(windows() > 0);
    if (time != 0.4) continue;
    if (change.puff) two.simulation().use_threads(2, sizes);
    before = windows();
  }
  // There is no window while a wall moves.
  if (!change.piston) CHECK(windows() > before);
}

}  // namespace

TEST_CASE("Acts: halts, a saved scene and a run continued at any event change no bit") {
  for (const Act& act : all_acts()) {
    CAPTURE(act.name);
    ScheduledRun<2> whole(act.scene, kActSeed);
    whole.run_until(6.0);
    const auto& counts = whole.simulation().counts();
    REQUIRE(counts.nudges + counts.strokes + counts.puffs == act.acts);
    const std::uint64_t hash = whole.simulation().state_hash();
    ScheduledRun<2> again(parse_scene(scene_to_toml(act.scene), "again.toml"), kActSeed);
    again.show(act.scene.view);
    bool arrived = false;
    while (!arrived) {
      const std::uint64_t next = again.simulation().counts().steps() + 1;
      arrived = again.run_until(6.0, kNoLimit, next);
      if (next % 7 != 0) continue;
      ScheduledRun<2> rest(act.scene, kActSeed, again.simulation().save());
      rest.run_until(6.0);
      CHECK(rest.simulation().state_hash() == hash);
    }
    CHECK(again.simulation().state_hash() == hash);
    Scene other = act.scene;
    other.changes.pop_back();
    CHECK(hash_of_run(other, 6.0) != hash);
  }
}

TEST_CASE("Acts: a run saved at the time of a change has the changes that are left to come") {
  for (const Act& act : all_acts()) {
    CAPTURE(act.name);
    const std::uint64_t whole = hash_of_run(act.scene, 6.0);
    Scene first_part = act.scene;
    first_part.changes.clear();
    for (const Change& change : act.scene.changes) {
      CAPTURE(first_part.changes.size());
      // Saved just before the change, and after all changes of its time.
      for (const Scene* scene : std::array<const Scene*, 2>{&first_part, &act.scene}) {
        ScheduledRun<2> begun(*scene, kActSeed);
        begun.run_until(change.time);
        ScheduledRun<2> rest(act.scene, kActSeed, begun.simulation().save());
        rest.run_until(6.0);
        CHECK(rest.simulation().state_hash() == whole);
      }
      first_part.changes.push_back(change);
    }
  }
}

TEST_CASE("Acts: time travel returns to the bits, particles and piston before and after them") {
  for (const Act& act : all_acts()) {
    CAPTURE(act.name);
    const auto run = watched_run(act.scene, kActSeed);
    run->run_until(6.0, kNoLimit, kNoLimit);
    for (const double time : {5.5, 0.9, 1.0, 2.0, 1.9, 3.0, 3.3, 3.2, 0.5, 4.25, 4.5, 5.0}) {
      CAPTURE(time);
      ScheduledRun<2> fresh(act.scene, kActSeed);
      fresh.run_until(time);
      run->go_back(time);
      while (run->time() < time) run->run_until(time, kNoLimit, run->counts().steps() + 100);
      const Frame frame = filled_frame(*run);
      const Snapshot& gas = frame.snapshot;
      CHECK(*frame.state_hash == fresh.simulation().state_hash());
      CHECK(gas.wall_displacement[kRight] == fresh.simulation().wall(kRight).displacement);
      const bool spins = !fresh.simulation().state().spins.empty();
      CHECK(gas.angles.size() == (spins ? gas.count() : 0));
      CHECK(frame.scene->particles.count == static_cast<int>(gas.count()));
      CHECK(frame.started->particles.count == act.scene.particles.count);
    }
  }
}

TEST_CASE("Acts: tiles change no bit, of disks and of spheres") {
  const std::string disks = "box.size = [60, 60]\nparticles.count = 900\n";
  const std::string change = "[[change]]\ntime = 0.4\n";
  const std::string stroke =
      "walls.left.kind = 'static'\nwalls.right = { kind = 'static', restitution = 0.9 }\n" +
      change + "piston = 44\nuntil = 1.1\n";
  check_tiles<2>(disks + change + "nudge = { centre = [30, 30], radius = 8, scale = 3 }\n");
  check_tiles<2>(disks + change + "puff = { count = 60, centre = [30, 30], radius = 25 }\n");
  check_tiles<2>(disks + stroke);
  check_tiles<3>("box.size = [60, 10, 10]\nparticles.count = 1500\n" + stroke);
}

TEST_CASE("Acts: by hand they are recorded at their time, and a run of the scene has the bits") {
  const Nudge heat{.centre = Vec2(6.0, 5.0), .radius = 3.0, .scale = 1.5};
  const Puff puff{.count = 7, .centre = Vec2(6.0, 5.0), .radius = 4.0, .temperature = 2.0};
  for (const bool adds : {false, true}) {
    for (const double at : {0.0, 1.7, 4.0}) {
      CAPTURE(adds);
      CAPTURE(at);
      const auto run = watched_run(parse_scene(kDrivenDisks, ""), kActSeed);
      const auto check_at = [&](double time) {
        CAPTURE(time);
        run->run_until(time, kNoLimit, kNoLimit);
        const Frame frame = filled_frame(*run);
        CHECK(hash_of_run(saved_scene(frame), time) == *frame.state_hash);
      };
      run->run_until(at, kNoLimit, kNoLimit);
      adds ? run->puff(puff, 0.01) : run->nudge(heat, 0.01);
      // A particle of the puff can be thrown.
      run->nudge({.particle = adds ? 46 : 7, .add = Vec2(0.0, 2.0)}, 0.0);
      const std::vector<Change> made = filled_frame(*run).scene->changes;
      REQUIRE(made.size() == 2);
      if (adds) CHECK(made[0].puff == puff);
      if (!adds) CHECK(made[0].nudge == heat);
      CHECK(made[0].time > 0.0);
      CHECK(made[0].time >= at);
      CHECK(made[0].time <= at + 0.01);
      CHECK(made[1].time == doctest::Approx(made[0].time).epsilon(1e-14));
      check_at(run->time());
      check_at(6.0);
      CHECK(filled_frame(*run).tally.nudges_in > 0.0);
      // The record has the states at the acts.
      for (const double time : {5.0, at + 0.02, 0.5 * at}) {
        run->go_back(time);
        check_at(time);
      }
    }
  }
}

TEST_CASE("Acts: a change of dimension removes them, and names the key") {
  for (const Act& act : all_acts()) {
    CAPTURE(act.name);
    const ChangedDimension changed = change_dimension(act.scene, 3);
    REQUIRE(changed.scene.changes.size() == act.other_changes);
    for (const Change& change : changed.scene.changes) CHECK_FALSE(change.nudge);
    CHECK(std::ranges::find(changed.removed, "change") != changed.removed.end());
  }
}

TEST_CASE("Acts: impossible ones are refused with their place") {
  const std::string box = "box.size = [12, 10]\nparticles.count = 30\n";
  const std::string change = "[[change]]\ntime = 1\n";
  const std::string gas = box + change;  // line 5 follows
  const std::string piston = box +
                             "walls.left = { kind = 'sawtooth', stroke = 2.0, frequency = 0.1 }\n" +
                             "walls.right.kind = 'static'\n" + change;  // line 7 follows
  struct Mistake {
    std::string text, place, words;
  };
  const Mistake mistakes[] = {
      {gas + "nudge = { centre = [13, 5], radius = 1, scale = 2 }", "5:11", "outside of the box"},
      {gas + "nudge = { centre = [3, 5, 1], radius = 1, scale = 2 }", "5:11", "3 numbers"},
      {gas + "nudge = { centre = [3, 5], radius = 0, scale = 2 }", "5:28", "greater than 0"},
      {gas + "nudge = { centre = [3, 5], scale = 2 }", "5", "no radius"},
      {gas + "nudge = { centre = [nan, 5], radius = 1, scale = 2 }", "5:11", "cannot be"},
      {gas + "nudge = { centre = [3, 5], radius = 1, add = [inf, 0] }", "5:40", "cannot be"},
      {gas + "nudge = { centre = [3, 5], radius = 1 }", "5", "changes no velocity"},
      {gas + "nudge = { scale = 2 }", "5", "no particles"},
      {gas + "nudge = { particle = 30, set = [1, 1] }", "5:11", "0 to 29"},
      {gas + "nudge = { particle = 4, scale = 2 }", "5:25", "one particle"},
      {gas + "nudge = { particle = 4, add = [1, 1], set = [1, 1] }", "5:39", "one of scale"},
      {gas + "nudge = { particle = 4, set = [1, 1] }\nset = { 'particles.restitution' = 0.5 }\n"
             "ramp = 'linear'\nuntil = 4",
       "7:1", "a nudge has no ramp"},
      {gas + "nudge = { particel = 4, set = [1, 1] }", "5:11", "'particle'"},
      {piston + "piston = 3.0\nuntil = 2", "7:1", "above 3, up to 12"},
      {piston + "piston = 12.5\nuntil = 2", "7:1", "move to x = 12.5"},
      {piston + "piston = 8.0", "", "until"},
      {piston + "piston = 8.0\nuntil = 1.0", "8:1", "greater than 1"},
      {piston + "piston = 'in'\nuntil = 2", "7:1", ""},
      {piston + "until = 2", "7:1", "without a ramp or a piston"},
      {piston + "piston = 8.0\nuntil = 2\nset = { 'walls.left.stroke' = 1.0 }", "7:1", "its own"},
      {piston + "piston = 8.0\nuntil = 2\nnudge = { particle = 1, set = [1, 1] }", "7:1",
       "its own"},
      {piston + "piston = 8.0\nuntil = 3\n[[change]]\ntime = 2.5\npiston = 9\nuntil = 4", "10:1",
       "until t = 3 "},
      {piston + "piston = 8.0\nuntil = 1.0000000000000002", "8:1", "speed"},
      {gas + "piston = 8.0\nuntil = 2", "5:1", "which the box lacks"},
      {gas + "puff = { centre = [1, 1], radius = 2 }", "5:", "'change.puff.count'"},
      {gas + "puff = { count = 3, radius = 2 }", "5:", "'change.puff.centre'"},
      {gas + "puff = { count = 3, centre = [1, 1] }", "5:", "'change.puff.radius'"},
      {gas + "puff = { count = 0, centre = [1, 1], radius = 2 }", "5:10", "between 1"},
      {gas + "puff = { count = 3, centre = [1, 1, 1], radius = 2 }", "5:21", "3 numbers"},
      {gas + "puff = { count = 3, centre = [1, 1], radius = 2, velocity = [1, 1, 1] }", "5:50",
       "3 numbers"},
      {gas + "puff = { count = 3, centre = [1, 11], radius = 2 }", "5:21", "at 11 along y"},
      {gas + "puff = { count = 3, centre = [1, 1], radius = 2 }\nset = { 'particles.restitution' = "
             "0.5 }",
       "5:8", "no other key"},
      {gas + "puff = { count = 3, centre = [1, 1], radius = 2 }\n[[change]]\ntime = 0.9\n"
             "nudge = { particle = 30, set = [1, 0] }",
       "8:11", "there is no particle 30"},
  };
  for (const auto& [text, place, words] : mistakes) {
    CAPTURE(text);
    const std::string message = refusal(text + "\n");
    CAPTURE(message);
    CHECK(says(message, "s.toml:" + place));
    CHECK(says(message, words));
  }
  CHECK(refusal(gas + "puff = { count = 3, centre = [1, 1], radius = 2 }\n" + change +
                "nudge = { particle = 32, set = [1, 0] }\n") == "");
}
