#include <doctest/doctest.h>

#include <limits>

#include "engine/scene/schedule.h"
#include "tests/engine/scene/refusal.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

const std::string kBox =
    "[particles]\ncount = 10\nrestitution = 0.9\n[walls.left]\nkind = 'driven'\ndrive_speed = 1\n"
    "[walls.right]\nkind = 'static'\n";

Scene scene_with_changes(const std::string& changes) {
  return parse_scene(kBox + changes, "s.toml");
}

}  // namespace

TEST_CASE("Schedule: changes apply in the order of their times, all keys of one together") {
  const Scene scene = scene_with_changes(
      "[[change]]\ntime = 7\nset = { 'walls.left' = { kind = 'thermal', temperature = 2.0 } }\n"
      "[[change]]\ntime = 3\nset = { 'particles.restitution' = 0.5, collapse.contact_time = 1e-3 "
      "}\n"
      "[[change]]\ntime = 3\n[change.set]\nparticles.restitution = 0.6\n");
  Schedule schedule(scene);
  CHECK(schedule.next() == 3.0);
  CHECK(schedule.scene().particles.restitution == 0.9);
  schedule.advance();
  CHECK(schedule.scene().particles.restitution == 0.5);
  CHECK(schedule.scene().contact_time == 1e-3);
  CHECK(schedule.next() == 3.0);
  schedule.advance();
  CHECK(schedule.scene().particles.restitution == 0.6);
  CHECK(schedule.scene().walls[kLeft]->kind == WallKind::Driven);
  schedule.skip_to(7.0);
  CHECK(schedule.scene().walls[kLeft]->kind == WallKind::Thermal);
  CHECK(schedule.scene().walls[kLeft]->temperature == 2.0);
  CHECK(schedule.next() == std::numeric_limits<double>::infinity());
  CHECK(schedule.scene().changes.size() == 3);
}

TEST_CASE("Schedule: spins go with the friction, and come back with the numbers that they had") {
  const Scene scene = parse_scene(
      "[particles]\ncount = 10\nfriction = 0.4\ninertia = 0.45\n"
      "[[change]]\ntime = 3\nset = { 'particles.friction' = 0.0 }\n"
      "[[change]]\ntime = 4\nset = { 'particles.friction' = 0.3 }\n",
      "s.toml");
  Schedule schedule(scene);
  schedule.skip_to(3.0);
  CHECK_FALSE(schedule.scene().spins());
  schedule.skip_to(4.0);
  CHECK(schedule.scene().spins());
  CHECK(schedule.scene().particles.inertia == 0.45);
}

TEST_CASE("Schedule: a ramp goes from the value in force to its own in equal steps, and arrives") {
  Schedule schedule(
      scene_with_changes("[[change]]\ntime = 10\nset = { 'particles.restitution' = 0.3 }\n"
                         "ramp = 'linear'\nuntil = 74\n"));
  for (int step = 1; step <= Schedule::kRampSteps; ++step) {
    REQUIRE(schedule.next() == 10.0 + step);
    schedule.advance();
    CHECK(schedule.scene().particles.restitution ==
          doctest::Approx(0.9 - 0.6 * step / Schedule::kRampSteps).epsilon(1e-13));
  }
  CHECK(schedule.scene().particles.restitution == 0.3);
  CHECK(schedule.next() == std::numeric_limits<double>::infinity());
}

TEST_CASE("Schedule: a ramp of a rough partner begins at the default beside the other number") {
  const Scene scene = scene_with_changes(
      "friction = 0.2\n[[change]]\ntime = 0\nuntil = 64\nramp = 'linear'\n"
      "set = { 'walls.right.tangential_restitution' = 0.36 }\n");
  Schedule schedule(scene);
  schedule.skip_to(1.0);
  CHECK(*schedule.laws().walls[kRight]->roughness.tangential_restitution == doctest::Approx(0.99));
  schedule.skip_to(64.0);
  CHECK(*schedule.laws().walls[kRight]->roughness.tangential_restitution == 0.36);
}

TEST_CASE("Schedule: a change added during the run comes before later ones") {
  Schedule schedule(
      scene_with_changes("[[change]]\ntime = 5\nset = { 'particles.restitution' = 0.5 }\n"));
  schedule.add({.time = 2.0, .set = {{"walls.left.drive_speed", "3.0"}}});
  CHECK(schedule.next() == 2.0);
  schedule.advance();
  CHECK(schedule.scene().walls[kLeft]->drive_speed == 3.0);
  CHECK(schedule.scene().particles.restitution == 0.9);
}

TEST_CASE("Schedule: from a time on, it continues as the schedule that went there") {
  const Scene scene = scene_with_changes(
      "[[change]]\ntime = 3\nset = { 'particles.restitution' = 0.5 }\n"
      "[[change]]\ntime = 4\nuntil = 12\nramp = 'linear'\nset = { 'walls.left.drive_speed' = 9 "
      "}\n");
  for (const double time : {2.0, 3.0, 3.5, 4.0, 5.0, 5.03, 11.99, 12.0, 20.0}) {
    CAPTURE(time);
    Schedule whole(scene);
    whole.skip_to(time);
    Schedule rest(whole.scene(), time);
    CHECK(rest.next() == whole.next());
    CHECK(rest.scene().changes.size() == 2);
    for (const double later : {6.5, 30.0}) {
      whole.skip_to(later);
      rest.skip_to(later);
      CHECK(rest.laws().particles.restitution == 0.5);
      CHECK(rest.laws().walls[kLeft]->drive_speed == whole.laws().walls[kLeft]->drive_speed);
    }
  }
}

TEST_CASE("Schedule: changes are written as a scene file that reads back") {
  const Scene scene = scene_with_changes(
      "[[change]]\ntime = 1.5\nset = { 'particles.restitution' = 0.5, walls.left = {kind = "
      "'static'} "
      "}\n"
      "[[change]]\ntime = 2\nset = { 'walls.left.restitution' = 0.25 }\nramp = 'linear'\n"
      "until = 60\n");
  const Scene again = parse_scene(scene_to_toml(scene), "again.toml");
  CHECK(again.changes == scene.changes);
  CHECK(scene_to_toml(again) == scene_to_toml(scene));
  CHECK(says(scene_to_json(scene), "\"change\": [{\"time\": 1.5, \"set\": {"));
}

// Laws do not contain the list of changes. With it, 20,000 changes would need 20,000 copies of
// 20,000.
TEST_CASE("Schedule: laws are without the changes, and any number of these comes in order") {
  Scene scene = scene_with_changes("");
  constexpr int kChanges = 20'000;
  for (int i = 0; i < kChanges; ++i) {
    const int number = (i * 7919) % kChanges;  // unsorted
    scene.changes.push_back({.time = 0.5 * number, .set = {{"particles.restitution", "0.5"}}});
  }
  Schedule schedule(scene);
  double last = -1.0;
  for (int i = 0; i < 100; ++i) {
    CHECK(schedule.next() == 0.5 * i);
    CHECK(schedule.next() > last);
    last = schedule.next();
    schedule.advance();
    CHECK(schedule.laws().changes.empty());
  }
  CHECK(schedule.scene().changes.size() == kChanges);
}

TEST_CASE("Schedule: impossible changes are refused with their place") {
  const std::string head = "[[change]]\ntime = 1\n";
  const std::vector<std::pair<std::string, std::vector<const char*>>> wrong = {
      {"[[change]]\nset = {}\n", {"s.toml:9:1", "'change.time' is missing"}},
      {head, {"s.toml:9:1", "a change needs 'set', 'nudge', 'puff', 'piston' or 'reverse'"}},
      {head + "set = 3\n", {"s.toml:11:1", "table of keys"}},
      {head + "set = { 'particles.count' = 20 }\n",
       {"s.toml:9:1", "particles.count", "cannot change"}},
      {head + "set = { 'particles.restitution' = 2 }\n", {"s.toml:9:1", "between 0 and 1"}},
      {head + "set = { 'particles.restitutoin' = 1 }\n", {"s.toml:9:1", "cannot change"}},
      {head + "set = { 'walls.left.drive_sped' = 1 }\n", {"s.toml:9:1", "'drive_speed'"}},
      {head + "set = { 'walls.top' = { kind = 'static' } }\n", {"s.toml:9:1", "[walls.top]"}},
      {head + "sett = {}\n", {"s.toml:11:8", "unknown key 'sett'"}},
      {head + "set = {}\nuntil = 4\n",
       {"s.toml:12:1: 'change.until' has no meaning without a ramp or a piston; remove it, or"}},
      {head + "set = {}\nramp = 'linear'\nuntil = 0.5\n", {"s.toml:13:1", "greater than 1"}},
      {head + "set = { 'particles.friction' = 0.5 }\nramp = 'linear'\nuntil = 4\n",
       {"s.toml:9:1", "'particles.friction' has no number to start from"}},
      {head + "set = { 'particles.friction' = inf }\n[[change]]\ntime = 2\n"
              "set = { 'particles.friction' = 0.5 }\nramp = 'linear'\nuntil = 4\n",
       {"s.toml:12:1", "'particles.friction' has no ramp from inf; use a large number"}},
      {head + "set = { 'particles.friction' = 0.5 }\n[[change]]\ntime = 2\n"
              "set = { 'particles.friction' = inf }\nramp = 'linear'\nuntil = 4\n",
       {"s.toml:12:1", "'particles.friction' has no ramp to inf; use a large number"}},
      {head + "set = { \"particles.\\u001b[2J\\u0000x\" = 1 }\n",
       {"'particles.\\u001b[2J\\u0000x' cannot change"}},
  };
  for (const auto& [text, parts] : wrong) {
    CAPTURE(text);
    const std::string message = refusal(kBox + text);
    CAPTURE(message);
    for (const char* part : parts) CHECK(says(message, part));
  }
  CHECK(says(refusal("change = 3\n" + kBox), "cannot be 3"));
  const std::string walls =
      "'walls.back' = { kind = 'static' }, 'walls.front' = { kind = 'static' }";
  CHECK(says(refusal(kSpheres + head + "set = { " + walls + " }\n"), "walls are added or removed"));
}
