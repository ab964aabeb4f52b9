#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "engine/error.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/support/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene vibrated() {
  return load_scene("vibrated", {{"view.window", "2.0"}});
}

// A gas between a saw-tooth wall and a thermal wall. At t = 10.3 the saw-tooth has 0.3 of its
// stroke.
Scene shaken(const std::string& changes = "") {
  return parse_scene(
      "box.size = [12, 10]\nparticles = { count = 60, restitution = 0.9 }\n"
      "walls.left = { kind = 'sawtooth', stroke = 0.5, frequency = 1 }\n"
      "walls.right = { kind = 'thermal', temperature = 1.5 }\n" +
          changes,
      "");
}

}  // namespace

TEST_CASE("ScheduledRun: laws that change to themselves change no bit of the run") {
  Scene scene = vibrated();
  ScheduledRun<2> plain(scene, 11);
  for (double time : {1.0, 1.7, 8.25}) {
    scene.changes.push_back({.time = time, .set = {{"particles.restitution", "0.9"}}});
  }
  ScheduledRun<2> changing(scene, 11);
  plain.run_until(12.0);
  changing.run_until(12.0);
  CHECK(changing.simulation().state_hash() == plain.simulation().state_hash());
}

TEST_CASE("ScheduledRun: spheres change their laws, and resume, to the bit") {
  Scene scene = rough_spheres(30);
  ScheduledRun<3> plain(scene, 17);
  plain.run_until(6.0);
  scene.changes = {{.time = 2.0, .set = {{"particles.restitution", "0.8"}}},
                   {.time = 3.0, .set = {{"gravity.acceleration", "[0.1, 0.2, 0.3]"}}}};
  ScheduledRun<3> whole(scene, 17), first(scene, 17);
  whole.run_until(6.0);
  CHECK(whole.simulation().state_hash() != plain.simulation().state_hash());
  CHECK(whole.simulation().model().gravity == Vec<3>(0.1, 0.2, 0.3));
  first.run_until(2.5);
  ScheduledRun<3> rest(scene, 17, first.simulation().save());
  rest.run_until(6.0);
  CHECK(rest.simulation().state_hash() == whole.simulation().state_hash());
}

TEST_CASE("ScheduledRun: the live field continues with other observers") {
  const Scene scene = vibrated();
  ScheduledRun<2> plain(scene, 14), changing(scene, 14);
  plain.show(scene.view);
  changing.show(scene.view);
  for (int part = 1; part <= 50; ++part) {
    plain.run_until(0.1 * part);
    changing.run_until(0.1 * part);
    changing.show(scene.view);
  }
  const FieldMap a = *plain.snapshot().field, b = *changing.snapshot().field;
  REQUIRE(a.values.size() == b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    CHECK(b.values[i] == doctest::Approx(a.values[i]).epsilon(1e-9));
  }
}

TEST_CASE("ScheduledRun: the live field restarts at a change of laws") {
  Scene scene = load_scene("vibrated", {{"view.window", "8.0"}});
  ScheduledRun<2> plain(scene, 14), late(scene, 14);
  scene.changes = {{.time = 2.0, .set = {{"particles.restitution", "0.9"}}}};
  ScheduledRun<2> changing(scene, 14);
  for (ScheduledRun<2>* run : {&plain, &changing}) run->show(scene.view);
  late.run_until(2.0);
  late.show(scene.view);
  for (ScheduledRun<2>* run : {&plain, &changing, &late}) run->run_until(4.0);
  const FieldMap whole = *plain.snapshot().field, changed = *changing.snapshot().field;
  const FieldMap last = *late.snapshot().field;  // the average of the last two time units alone
  REQUIRE(changed.values.size() == last.values.size());
  double difference = 0.0;
  for (std::size_t i = 0; i < last.values.size(); ++i) {
    CHECK(changed.values[i] == doctest::Approx(last.values[i]).epsilon(1e-9));
    difference = std::max(difference, std::fabs(changed.values[i] - whole.values[i]));
  }
  CHECK(difference > 0.1);
}

TEST_CASE("ScheduledRun: pictures show flights and angles if asked to, and particles turn on") {
  const Scene scene = load_scene("rough_driven");
  ScheduledRun<2> plain(scene, 16), shown(scene, 16);
  plain.run_until(1.0);
  shown.show(scene.view);
  shown.run_until(0.5);
  CHECK(plain.snapshot().angles.empty());
  CHECK(shown.snapshot().angles.size() == shown.simulation().particles().size());
  CHECK(shown.snapshot().flights.empty());
  // Observers of a previous view must not be called.
  View view = scene.view;
  constexpr std::array<std::optional<Field>, 4> kShown = {
      Quantity::Density, std::nullopt, Field(Quantity::Stress, 0, 0), Quantity::BalanceEnergy};
  for (int k = 1; k <= 20; ++k) {
    view.field = kShown[static_cast<std::size_t>(k) % kShown.size()];
    shown.show(view, 0.01);
    shown.run_until(0.5 + 0.025 * k);
    const Snapshot snapshot = shown.snapshot();
    REQUIRE(snapshot.field.has_value() == view.field.has_value());
    if (view.field) CHECK(snapshot.field->field == *view.field);
  }
  CHECK(shown.snapshot().exposure == doctest::Approx(0.01));
  CHECK(shown.snapshot().flights.size() >= shown.simulation().particles().size());
  CHECK(shown.simulation().state_hash() == plain.simulation().state_hash());
  ScheduledRun<2> steady(scene, 16);
  steady.show(scene.view);
  steady.run_until(1.0);
  const std::vector<double> a = shown.snapshot().angles, b = steady.snapshot().angles;
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == b[i]);
}

TEST_CASE("ScheduledRun: arrows and balances continue across the steps of ramps") {
  View view = vibrated().view;
  view.arrows = Quantity::HeatFlux;
  for (const Field field : {Quantity::Temperature, Quantity::BalanceEnergy}) {
    view.field = field;
    const auto at_ten = [&](const std::vector<double>& times) {
      Scene scene = vibrated();
      for (const double time : times) {
        scene.changes.push_back({.time = time,
                                 .set = {{"particles.restitution", "0.9"}},
                                 .ramp = Ramp::Linear,
                                 .until = time + 0.1});
      }
      ScheduledRun<2> run(scene, 15);
      run.show(view);
      run.run_until(10.0);
      return run.snapshot();
    };
    const Snapshot plain = at_ten({}), changed = at_ten({8.5, 9.25, 9.75});
    CHECK(changed.field->whole_window);
    REQUIRE(changed.arrows->arrows.size() == plain.arrows->arrows.size());
    REQUIRE(plain.arrows->arrows.size() > 10);
    double longest = 0.0;
    for (const auto& arrow : plain.arrows->arrows) longest = std::max(longest, arrow.value.norm());
    for (std::size_t k = 0; k < plain.arrows->arrows.size(); ++k) {
      const Vec2 off = changed.arrows->arrows[k].value - plain.arrows->arrows[k].value;
      CHECK(off.norm() < 1e-10 * longest);
    }
    // The balance closes under each of the laws, and the same cells have a residual.
    for (std::size_t i = 0; i < plain.field->values.size(); ++i) {
      CHECK(std::isnan(changed.field->values[i]) == std::isnan(plain.field->values[i]));
      if (field == Quantity::BalanceEnergy && !std::isnan(plain.field->values[i])) {
        CHECK(std::fabs(changed.field->values[i]) < 1e-12);
      }
    }
  }
}

TEST_CASE("ScheduledRun: impossible changes are refused, and change nothing") {
  ScheduledRun<2> run(vibrated(), 15);
  run.run_until(3.0);
  CHECK_THROWS_AS(run.change({{"particles.restitution", "1.5"}}), UserError);
  CHECK_THROWS_AS(run.change({{"particles.count", "5"}}), UserError);
  // A new wall position far inside would overlap particles.
  CHECK_THROWS_AS(run.change({{"walls.left",
                               "{ kind = 'sawtooth', stroke = 6.0, frequency = 0.01,"
                               " phase = 0.9 }"}}),
                  PhysicalStop);
  CHECK(run.scene().changes.empty());
  CHECK(run.scene().particles.restitution == 0.9);
  CHECK(run.run_until(4.0));
}

TEST_CASE("ScheduledRun: averages resumed from a checkpoint equal one run, to the bit") {
  for (const std::string field : {"temperature", "balance_energy"}) {
    CAPTURE(field);
    Scene scene = load_scene("vibrated", {{"view.window", "2.0"}, {"view.field", field}});
    scene.view.arrows = Quantity::Velocity;
    scene.changes = {{.time = 4.0, .set = {{"particles.restitution", "0.8"}}}};
    ScheduledRun<2> whole(scene, 14);
    whole.show(scene.view);
    whole.run_until(3.1);  // inside a part of a window
    whole.snapshot();
    whole.run_until(3.2);
    const std::string averages = whole.save_shown();
    ScheduledRun<2> resumed(scene, 14, whole.simulation().save());
    resumed.show(scene.view, averages);
    for (const double time : {3.3, 4.7, 9.0}) {
      whole.run_until(time);
      resumed.run_until(time);
      const Snapshot wanted = whole.snapshot(), found = resumed.snapshot();
      REQUIRE(found.field->values.size() == wanted.field->values.size());
      CHECK(std::ranges::equal(found.field->values, wanted.field->values, {},
                               std::bit_cast<std::uint64_t, double>,
                               std::bit_cast<std::uint64_t, double>));
      CHECK(found.field->whole_window == wanted.field->whole_window);
      REQUIRE(found.arrows->arrows.size() == wanted.arrows->arrows.size());
      for (std::size_t i = 0; i < found.arrows->arrows.size(); ++i) {
        CHECK(found.arrows->arrows[i].value == wanted.arrows->arrows[i].value);
      }
    }
  }
}

static void check_same_flights(const std::vector<FlightPiece>& found,
                               const std::vector<FlightPiece>& wanted) {
  REQUIRE(found.size() == wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].particle == wanted[i].particle);
    CHECK(found[i].from == wanted[i].from);
    CHECK(found[i].position == wanted[i].position);
  }
}

TEST_CASE("ScheduledRun: flights and angles resumed from a checkpoint equal one run") {
  Scene scene = load_scene("rough_driven", {{"view.field", "density"},
                                            {"view.trails", "0.8"},
                                            {"view.tracer", "{ particle = 5, time = 1.7 }"}});
  scene.changes = {{.time = 2.3, .set = {{"gravity.acceleration", "[0.0, -1.0]"}}}};
  ScheduledRun<2> whole(scene, 15);
  whole.show(scene.view, 0.1);
  whole.run_until(2.0);
  const std::string shown = whole.save_shown();
  ScheduledRun<2> resumed(scene, 15, whole.simulation().save());
  resumed.show(scene.view, shown, 0.1);
  for (const double time : {2.0, 2.4, 5.0}) {
    whole.run_until(time);
    resumed.run_until(time);
    const Snapshot wanted = whole.snapshot(), found = resumed.snapshot();
    CHECK(found.exposure == wanted.exposure);
    CHECK(found.angles == wanted.angles);
    check_same_flights(found.flights, wanted.flights);
    check_same_flights(found.traced, wanted.traced);
    CHECK(wanted.traced.front().particle == 5);
  }
  View other = scene.view;
  other.trails.reset();
  ScheduledRun<2> unlike(scene, 15, whole.simulation().save());
  CHECK_THROWS_AS(unlike.show(other, shown), UserError);
}

TEST_CASE("ScheduledRun: a request to stop halts it between changes of laws") {
  Scene scene = vibrated();
  scene.changes.push_back({.time = 1.0,
                           .set = {{"particles.restitution", "0.5"}},
                           .ramp = Ramp::Linear,
                           .until = 1.064});
  ScheduledRun<2> run(scene, 16);
  const auto changes = [&] { return run.simulation().counts().law_changes; };
  CHECK_FALSE(run.run_until(2.0, kNoLimit, kNoLimit, [&] { return changes() == 3; }));
  CHECK(changes() == 3);
  CHECK(run.run_until(2.0));
  CHECK(changes() == Schedule::kRampSteps);
  CHECK_THROWS_AS(ScheduledRun<2>(scene, 16, [] { return true; }), Interrupted);
}

TEST_CASE("ScheduledRun: a wall whose frequency changes continues from its place") {
  const auto displacement = [](const ScheduledRun<2>& run) {
    return run.simulation().wall(kLeft).displacement;
  };
  ScheduledRun<2> run(shaken(), 1);
  run.run_until(10.3);
  CHECK(displacement(run) == doctest::Approx(0.15));
  run.change({{"walls.left.frequency", "1.5"}});
  CHECK(displacement(run) == doctest::Approx(0.15));
  run.run_until(10.5);
  CHECK(displacement(run) == doctest::Approx(0.5 * (0.3 + 1.5 * 0.2)));
  run.change({{"walls.left.frequency", "0"}});
  run.run_until(20.0);
  CHECK(displacement(run) == doctest::Approx(0.3));
  run.change({{"walls.left.frequency", "2"}});
  run.run_until(20.15);
  CHECK(displacement(run) == doctest::Approx(0.5 * 0.9));
  // A wall at rest is at its rest position. It begins to move from its phase.
  run.change({{"walls.left", "{ kind = 'static' }"}});
  CHECK(displacement(run) == 0.0);
  run.run_until(23.7);
  run.change({{"walls.left", "{ kind = 'sinusoidal', stroke = 0.5, frequency = 0.5, phase = 1 }"}});
  CHECK(displacement(run) == doctest::Approx(0.0));
  run.run_until(24.2);
  CHECK(displacement(run) == doctest::Approx(0.25));
}

TEST_CASE(
    "ScheduledRun: changes of a wall's motion are played, resumed and ramped to the same bits") {
  const Scene scene = shaken(
      "[[change]]\ntime = 10.3\nset = { 'walls.left.frequency' = 1.5 }\n"
      "[[change]]\ntime = 12.1\nset = { 'walls.left.frequency' = 0.2 }\nramp = 'linear'\n"
      "until = 16\n");
  ScheduledRun<2> straight(scene, 1);
  REQUIRE(straight.run_until(20.0));

  ScheduledRun<2> live(shaken(), 1);
  live.run_until(10.3);
  live.change({{"walls.left.frequency", "1.5"}});
  live.run_until(12.0);
  Scene recorded = shaken();
  recorded.changes = live.scene().changes;
  ScheduledRun<2> played(recorded, 1);
  played.run_until(12.0);
  CHECK(live.simulation().state_hash() == played.simulation().state_hash());

  for (const double time : {10.3, 11.0, 14.123}) {
    CAPTURE(time);
    ScheduledRun<2> first(scene, 1);
    first.run_until(time);
    ScheduledRun<2> resumed(scene, 1, first.simulation().save());
    resumed.run_until(20.0);
    CHECK(resumed.simulation().state_hash() == straight.simulation().state_hash());
  }
}

TEST_CASE(
    "ScheduledRun: a change that moves a wall into a particle names the wall, and a time for it") {
  const auto refusal_at = [](double time) {
    Scene scene = shaken();
    scene.changes = {{.time = time, .set = {{"walls.left.stroke", "4"}}}};
    ScheduledRun<2> run(scene, 1);
    try {
      run.run_until(12.0);
    } catch (const PhysicalStop& stop) {
      return std::string(stop.what());
    }
    return std::string();
  };
  CHECK(says(refusal_at(10.75), "the change of walls.left at t = 10.75 moves a wall into a"));
  CHECK(says(refusal_at(10.75),
             "change walls.left without a ramp at its rest position, as at t = 11.0001"));
  CHECK(refusal_at(11.0001) == "");
}

TEST_CASE("ScheduledRun: a live change of a stroke waits until no particle is in its way") {
  ScheduledRun<2> run(shaken(), 1);
  run.run_until(10.75);
  run.change({{"walls.left.stroke", "4"}});
  CHECK(run.laws().walls[0]->stroke == 4.0);
  CHECK(run.simulation().time() > 10.75);
  CHECK(run.simulation().time() <= 11.8);
}

// Disks of a lattice touch the wall at time 0. Their collisions come before the change.
TEST_CASE("Scheduled run: a run saved among the events of a change's time has the change to come") {
  const Scene scene = parse_scene(
      "box.size = [3.3, 11.0]\nparticles = { count = 23, start.layout = 'lattice' }\n"
      "walls.left.kind = 'static'\nwalls.right = { kind = 'thermal', temperature = 0.5 }\n"
      "[[change]]\ntime = 0.0\nset = { 'walls.right.temperature' = 0.1 }\n",
      "");
  ScheduledRun<2> whole(scene, 1);
  ScheduledRun<2> early(scene, 1, whole.simulation().save());
  whole.run_until(0.0);
  ScheduledRun<2> late(scene, 1, whole.simulation().save());
  CHECK(whole.simulation().counts().wall_collisions > 0);
  for (ScheduledRun<2>* run : {&whole, &early, &late}) run->run_until(1.0);
  CHECK(early.simulation().state_hash() == whole.simulation().state_hash());
  CHECK(late.simulation().state_hash() == whole.simulation().state_hash());
  CHECK(late.simulation().counts().law_changes == 1);
}
