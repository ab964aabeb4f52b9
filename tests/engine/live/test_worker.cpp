#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cmath>

#include "engine/live/worker.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/support/scenes.h"

using namespace clatter;
using namespace clatter::testing;
using namespace std::chrono_literals;

namespace {

using RealClock = std::chrono::steady_clock;

Scene scene_at_speed(const std::string& name, double speed) {
  return load_scene(name, {{"view.speed", std::to_string(speed)}});
}

// Waits for a frame for which `is_it` holds. Fails after a long time without one, also on slow
// machines.
template <class IsIt>
const Frame& wait_for(Worker& worker, IsIt is_it) {
  const auto end = RealClock::now() + 100s;
  for (;;) {
    worker.frames().update();
    const Frame& frame = worker.frames().front();
    if (frame.run > 0 && is_it(frame)) return frame;
    REQUIRE(RealClock::now() < end);
    std::this_thread::sleep_for(1ms);
  }
}

const Frame& wait_for_handled(Worker& worker, std::uint64_t commands) {
  return wait_for(worker, [&](const Frame& frame) { return frame.handled >= commands; });
}

// CPU time of all threads.
double seconds_of(const rusage& usage) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

// test_pace.cpp shows with an artificial clock that the speed is kept. Here other processes may
// delay frames.
TEST_CASE("Worker: frames follow each other, and none comes before the speed asks for it") {
  Worker worker(60.0);
  const auto began = RealClock::now();
  worker.send(
      command::Open{load_scene("vibrated", {{"particles.count", "20"}, {"view.speed", "2.0"}})});
  double time = wait_for_handled(worker, 1).snapshot.time;
  for (int frames = 0; frames < 60; ++frames) {
    const Frame& next =
        wait_for(worker, [&](const Frame& frame) { return frame.snapshot.time > time; });
    time = next.snapshot.time;
  }
  const double seconds = std::chrono::duration<double>(RealClock::now() - began).count();
  CHECK(time < 2.0 * seconds + 0.1);
  const Frame& frame = worker.frames().front();
  CHECK(frame.held > 0.0);
  CHECK(frame.events_per_second > 0.0);
  CHECK(frame.tally.time == doctest::Approx(frame.snapshot.time));
  CHECK(frame.snapshot.field);
  CHECK(frame.message.empty());
}

TEST_CASE("Worker: it reports the share of the speed that it holds") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 1e7)});
  const Frame& frame = wait_for(worker, [](const Frame& frame) { return frame.held < 1.0; });
  CHECK(frame.held > 0.0);
  CHECK(frame.held < 0.5);
}

TEST_CASE("Worker: runs played, stepped and made without it have the same hash at a time") {
  const Scene scene = scene_at_speed("vibrated", 20.0);
  Worker worker(60.0);
  worker.send(command::Open{scene, 21});
  wait_for(worker, [](const Frame& frame) { return frame.snapshot.time > 5.0; });
  worker.send(command::Play{false});
  worker.send(command::StepCollision{});
  worker.send(command::Step{0.125});
  const Frame halted =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 4 && frame.state_hash; });
  CHECK_FALSE(halted.plays);
  const auto simulation = simulation_of<2>(scene, 21);
  simulation->run_until(halted.snapshot.time);
  CHECK(simulation->state_hash() == *halted.state_hash);
}

TEST_CASE("Worker: spheres play, change their laws, and stay in a box of another size") {
  Scene scene = rough_spheres(40);
  wall_in(scene, 2, Wall{});  // an oscillating wall would push out particles in its range
  Worker worker(60.0);
  worker.send(command::Open{scene, 26, false});
  worker.send(command::ShowProfile{Profiled::Fields});
  worker.send(command::Pick{7});
  worker.send(command::Play{true, 1.25});
  const Frame there =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 4 && !frame.plays; });
  REQUIRE(there.state_hash);
  const auto simulation = simulation_of<3>(scene, 26);
  simulation->run_until(1.25);
  CHECK(simulation->state_hash() == *there.state_hash);
  CHECK(there.tally.temperature_integral.size() == 3);
  CHECK(there.profile.has_value());
  worker.send(command::SetLaws{{{"particles.restitution", "0.7"}}});
  worker.send(command::StepCollision{});
  const Frame hit =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 6 && frame.state_hash; });
  CHECK(hit.scene->particles.restitution == 0.7);
  REQUIRE(hit.partners);
  const Vectors& places = hit.snapshot.positions;
  const auto [a, b] = *hit.partners;
  CHECK((places.col(a) - places.col(b)).norm() == doctest::Approx(1.0).epsilon(1e-12));

  Scene wider = *hit.scene;
  wider.box[2] += 2.0;
  worker.send(command::Open{wider, 26, false, true, Vec<3>(0.0, 0.0, 2.0)});
  const Frame moved = wait_for_handled(worker, 7);
  CHECK(moved.message == "");
  REQUIRE(moved.snapshot.count() == 40);
  const Vectors shifts = moved.snapshot.positions - places;
  CHECK((shifts.colwise() - Vec<3>(0.0, 0.0, 2.0)).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(moved.snapshot.velocities == hit.snapshot.velocities);
}

TEST_CASE("Worker: a gas of another dimension starts from its beginning") {
  Worker worker(60.0);
  worker.send(command::Open{load_scene("vibrated"), 1, false});
  worker.send(command::Open{rough_spheres(40), 27, false, true});
  const Frame frame = wait_for_handled(worker, 2);
  CHECK(frame.message == "");
  CHECK(frame.state_hash == simulation_of<3>(rough_spheres(40), 27)->state_hash());
}

TEST_CASE("Worker: it plays up to a time, halts there, and plays on when asked") {
  const Scene scene = scene_at_speed("vibrated", 20.0);
  Worker worker(60.0);
  worker.send(command::Open{scene, 24, false});
  worker.send(command::Play{true, 1.25});
  const Frame there =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 2 && !frame.plays; });
  REQUIRE(there.state_hash);
  CHECK(there.snapshot.time == 1.25);
  const auto simulation = simulation_of<2>(scene, 24);
  simulation->run_until(1.25);
  CHECK(simulation->state_hash() == *there.state_hash);
  worker.send(command::Play{true});
  wait_for(worker, [](const Frame& frame) { return frame.snapshot.time > 2.0; });
}

TEST_CASE("Worker: it steps to a frame, and to a collision, whose pair it names") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 2.0), 1, false});
  CHECK(wait_for_handled(worker, 1).snapshot.time == 0.0);
  worker.send(command::Step{0.25});
  const Frame frame =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 2 && frame.state_hash; });
  CHECK(frame.snapshot.time == 0.25);
  CHECK_FALSE(frame.partners);
  worker.send(command::StepCollision{});
  const Frame hit =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 3 && frame.state_hash; });
  CHECK(hit.snapshot.collisions == frame.snapshot.collisions + 1);
  REQUIRE(hit.partners);
  const auto [a, b] = *hit.partners;
  Vec2 apart = hit.snapshot.positions.col(a) - hit.snapshot.positions.col(b);
  apart.y() -= hit.snapshot.box.y() * std::round(apart.y() / hit.snapshot.box.y());
  CHECK(apart.norm() == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("Worker: laws that are set hold from then on, and its scene plays them back") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 10.0), 22});
  for (int i = 1; i <= 5; ++i) {
    std::this_thread::sleep_for(30ms);
    worker.send(command::SetLaws{{{"particles.restitution", std::to_string(0.9 - 0.1 * i)}}});
    worker.send(command::SetLaws{{{"walls.left.drive_speed", std::to_string(1.0 + i)}}});
  }
  worker.send(command::Play{false});
  worker.send(command::Step{1.0});
  const Frame frame =
      wait_for(worker, [](const Frame& frame) { return frame.handled == 13 && frame.state_hash; });
  CHECK(frame.message.empty());
  CHECK(frame.scene->particles.restitution == doctest::Approx(0.4));
  CHECK(frame.scene->changes.size() == 10);

  Scene scene = load_scene("vibrated");
  scene.changes = frame.scene->changes;
  ScheduledRun<2> played(parse_scene(scene_to_toml(scene), ""), 22);
  played.run_until(frame.snapshot.time);
  CHECK(played.simulation().state_hash() == *frame.state_hash);
}

TEST_CASE("Worker: if laws are set faster than they can change, the last ones count") {
  Worker worker(60.0);
  worker.send(command::Open{load_scene("cooling"), 1, false});
  for (int i = 1; i <= 200; ++i) {
    worker.send(command::SetLaws{{{"particles.restitution", std::to_string(0.9 - 0.001 * i)}}});
  }
  const Frame& frame = wait_for_handled(worker, 201);
  CHECK(frame.scene->particles.restitution == doctest::Approx(0.7));
  CHECK(frame.scene->changes.size() < 200);
}

TEST_CASE("Worker: each of many equal nudges counts, also of a gas that plays backwards") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 4.0), 1, false});
  const Nudge cool{.centre = Vec2(10.0, 12.0), .radius = 5.0, .scale = 0.9};
  for (int i = 0; i < 5; ++i) worker.send(command::Nudge{cool});
  const Frame five = wait_for_handled(worker, 6);
  CHECK(five.message == "");
  CHECK(five.scene->changes.size() == 5);
  worker.send(command::Step{20.0});
  wait_for(worker, [](const Frame& frame) { return frame.snapshot.time >= 20.0; });

  worker.send(command::PlayBackwards{});
  const double back =
      wait_for(worker, [](const Frame& frame) { return frame.snapshot.time < 19.0; }).snapshot.time;
  worker.send(command::Nudge{cool});
  worker.send(command::Play{false});
  const Frame halted = wait_for_handled(worker, 10);
  REQUIRE(halted.scene->changes.size() == 6);
  CHECK(halted.scene->changes.back().time <= back + 0.1);
  CHECK(halted.other_future);
  Scene scene = *halted.started;
  scene.changes = halted.scene->changes;
  ScheduledRun<2> alone(scene, 1);
  alone.run_until(halted.snapshot.time);
  CHECK(alone.simulation().state_hash() == *halted.state_hash);

  scene.changes.pop_back();
  worker.send(command::ReplaceChanges{scene.changes, halted.scene->changes.back().time});
  const Frame undone = wait_for_handled(worker, 11);
  CHECK(undone.scene->changes == scene.changes);
  CHECK(undone.snapshot.time == doctest::Approx(halted.scene->changes.back().time));
}

TEST_CASE("Worker: profiles come when asked for, and do not change the run") {
  const Scene scene = scene_at_speed("vibrated", 50.0);
  Worker worker(60.0);
  worker.send(command::Open{scene, 25});
  CHECK_FALSE(wait_for_handled(worker, 1).profile);
  worker.send(command::ShowProfile{Profiled::Fields});
  const Frame shown = wait_for(worker, [](const Frame& frame) {
    return frame.profile && !frame.profile->values.empty() && frame.snapshot.time > 30.0;
  });
  const std::vector<Estimate>& density = shown.profile->at(Quantity::Density);
  CHECK(density.size() == 20);
  double particles = 0.0;
  for (const Estimate& column : density) particles += column.mean * shown.snapshot.box.y();
  CHECK(particles == doctest::Approx(200.0).epsilon(1e-9));
  // Central band: its density exceeds the density at the walls by many standard errors.
  CHECK(density[10].mean > density[0].mean + 5.0 * density[10].standard_error);
  worker.send(command::ShowProfile{Profiled::Nothing});
  worker.send(command::Play{false});
  const Frame halted = wait_for_handled(worker, 4);
  CHECK_FALSE(halted.profile);
  const auto simulation = simulation_of<2>(scene, 25);
  simulation->run_until(halted.snapshot.time);
  CHECK(simulation->state_hash() == *halted.state_hash);
}

TEST_CASE("Worker: balance residuals come when asked for, and are roundings") {
  const Scene scene = scene_at_speed("vibrated", 50.0);
  Worker worker(60.0);
  worker.send(command::Open{scene, 29});
  worker.send(command::ShowProfile{Profiled::Balances});
  const Frame shown = wait_for(worker, [](const Frame& frame) {
    return frame.residuals && !frame.residuals->residuals.equations.empty() &&
           frame.snapshot.time > 10.0;
  });
  CHECK_FALSE(shown.profile);
  CHECK(shown.residuals->residuals.equations[0].size() == 20);
  CHECK(shown.residuals->width == doctest::Approx(shown.snapshot.box.x() / 20.0));
  // As in measurements: not zero, but far below the effect of a missing event.
  const std::vector<double> largest = shown.residuals->residuals.largest();
  CHECK(std::ranges::max(largest) < 1e-9);
  CHECK(largest[3] > 0.0);
  worker.send(command::Play{false});
  const Frame halted = wait_for_handled(worker, 3);
  const auto simulation = simulation_of<2>(scene, 29);
  simulation->run_until(halted.snapshot.time);
  CHECK(simulation->state_hash() == *halted.state_hash);
}

TEST_CASE("Worker: it predicts the next collision of a picked particle, then reports it") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 2.0), 26, false});
  worker.send(command::Pick{7});
  const Frame picked = wait_for(
      worker, [](const Frame& frame) { return frame.handled == 2 && frame.next_collision; });
  CHECK_FALSE(picked.last_collision);
  const double time = picked.next_collision->time;
  CHECK(time > 0.0);
  // Just before the event it is in the future, afterwards in the past.
  worker.send(command::Play{true, time * (1.0 - 1e-9)});
  const Frame before = wait_for(worker, [](const Frame& frame) {
    return frame.handled == 3 && frame.state_hash && frame.next_collision;
  });
  CHECK_FALSE(before.last_collision);
  CHECK(before.next_collision->time == doctest::Approx(time).epsilon(1e-12));
  worker.send(command::Play{true, time * (1.0 + 1e-9)});
  const Frame after = wait_for(worker, [](const Frame& frame) {
    return frame.handled == 4 && frame.state_hash && frame.next_collision;
  });
  REQUIRE(after.last_collision);
  CHECK(after.last_collision->time == doctest::Approx(time).epsilon(1e-12));
  CHECK(after.last_collision->partner == picked.next_collision->partner);
  CHECK(after.next_collision->time > time);
}

TEST_CASE("Worker: the predicted collision of a picked particle occurs while the gas plays") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 2.0), 30});
  worker.send(command::Pick{11});
  for (std::uint64_t i = 1; i <= 5; ++i) {
    // It is simulated under the current laws.
    worker.send(command::SetLaws{{{"particles.restitution", std::to_string(1.0 - 0.1 * i)}}});
    const Frame ahead = wait_for(worker, [&](const Frame& frame) {
      return frame.handled == 2 + i && frame.next_collision &&
             frame.next_collision->time > frame.snapshot.time;
    });
    CHECK(ahead.plays);
    const ParticleCollision expected = *ahead.next_collision;
    // The first frame after it. The particle may have had another collision since.
    const Frame after =
        wait_for(worker, [&](const Frame& frame) { return frame.snapshot.time >= expected.time; });
    REQUIRE(after.last_collision);
    CHECK(after.last_collision->time >= expected.time * (1.0 - 1e-12));
    if (after.last_collision->time > expected.time * (1.0 + 1e-12)) continue;
    CHECK(after.last_collision->partner == expected.partner);
    CHECK(after.last_collision->side == expected.side);
  }
  // The look-ahead does not change the run.
  worker.send(command::Play{false});
  const Frame halted = wait_for_handled(worker, 8);
  Scene scene = *halted.started;
  scene.changes = halted.scene->changes;
  ScheduledRun<2> alone(scene, 30);
  alone.run_until(halted.snapshot.time);
  CHECK(alone.simulation().state_hash() == *halted.state_hash);
}

TEST_CASE("Worker: a picked particle at rest has no next collision") {
  Worker worker(60.0);
  worker.send(command::Open{load_scene("equilibrium", {{"particles.start.temperature", "0.0"}}), 27,
                            false});
  worker.send(command::Pick{7});
  CHECK_FALSE(wait_for_handled(worker, 2).next_collision);
}

TEST_CASE("Worker: mistakes and stops are reported, and the gas halts") {
  Worker worker(60.0);
  worker.send(command::Open{load_scene("vibrated"), 1, false});
  worker.send(command::SetLaws{{{"particles.restitution", "7"}}});
  const Frame refused = wait_for_handled(worker, 2);
  CHECK(refused.messages == 1);
  CHECK(says(refused.message, "between 0 and 1"));
  CHECK(refused.scene->particles.restitution == 0.9);

  worker.send(command::Open{load_scene("collapse", {{"collapse", "{}"}, {"view.speed", "1000"}})});
  const Frame stopped = wait_for(worker, [](const Frame& frame) { return frame.messages == 2; });
  CHECK(stopped.run == 2);
  CHECK_FALSE(stopped.plays);
  CHECK(says(stopped.message, "contact_time"));
  // Halting gives no new message.
  worker.send(command::Play{false});
  CHECK(wait_for_handled(worker, 4).messages == 2);
  // It continues with a contact time.
  worker.send(command::SetLaws{{{"collapse.contact_time", "1e-5"}}});
  worker.send(command::Play{true});
  CHECK(wait_for(worker, [&](const Frame& frame) {
          return frame.snapshot.time > stopped.snapshot.time + 1.0;
        }).messages == 2);
}

TEST_CASE("Worker: if the run stops before the next collision, it reports none") {
  // A stroke that would move the bottom into the particles.
  Scene scene = load_scene("shaker");
  scene.changes = {{.time = 0.05, .set = {{"walls.bottom.stroke", "40"}}}};
  Worker worker(60.0);
  worker.send(command::Open{scene, 1, false});
  std::uint64_t commands = 1;
  do {
    worker.send(command::StepCollision{});
    ++commands;
    wait_for(worker, [&](const Frame& frame) {
      return frame.handled == commands && (frame.partners || frame.messages > 0);
    });
  } while (worker.frames().front().messages == 0);
  const Frame& stopped = worker.frames().front();
  CHECK(stopped.snapshot.time == 0.05);
  CHECK(stopped.snapshot.collisions > 0);
  CHECK(says(stopped.message, "into a particle"));
  CHECK_FALSE(stopped.partners);
}

// An invalid law that comes into force with the very collision of the step.
TEST_CASE("Worker: a mistake found when it halts is reported, too") {
  Scene scene = scene_at_speed("vibrated", 2.0);
  const auto hit = [](const Frame& frame) { return frame.handled == 2 && frame.partners; };
  double time = 0.0;
  {
    Worker worker(60.0);
    worker.send(command::Open{scene, 1, false});
    worker.send(command::StepCollision{});
    time = wait_for(worker, hit).snapshot.time;
  }
  scene.changes = {{.time = time, .set = {{"particles.restitution", "7"}}}};
  Worker worker(60.0);
  worker.send(command::Open{scene, 1, false});
  worker.send(command::StepCollision{});
  const Frame& there = wait_for(worker, hit);
  CHECK(there.messages == 1);
  CHECK(says(there.message, "between 0 and 1"));
}

TEST_CASE("Worker: a gas that is kept starts with its own temperature") {
  Worker worker(60.0);
  worker.send(
      command::Open{load_scene("vibrated", {{"particles.start.temperature", "4"}}), 1, false});
  worker.send(
      command::Open{load_scene("vibrated", {{"box.size", "[20.0, 30.0]"}}), 1, false, true});
  const Frame& frame = wait_for_handled(worker, 2);
  CHECK(frame.run == 2);
  CHECK(frame.scene->particles.start.temperature == doctest::Approx(4.0).epsilon(1e-12));
}

TEST_CASE("Worker: its thread sleeps while the gas halts") {
  Worker worker(60.0);
  worker.send(command::Open{load_scene("vibrated"), 1, false});
  wait_for_handled(worker, 1);
  std::this_thread::sleep_for(50ms);
  const auto usage = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage;
  };
  const rusage before = usage();
  std::this_thread::sleep_for(500ms);
  const rusage after = usage();
  // A thread that polls every 10 ms waits 50 times. The thread sanitizer's own thread waits 5
  // times.
  CHECK(after.ru_nvcsw - before.ru_nvcsw < 25);
  // A thread that polls without a pause uses all CPU time.
  CHECK(seconds_of(after) - seconds_of(before) < 0.25);
}

// At this speed the next frame needs hours of work.
TEST_CASE("Worker: it ends when asked to, also in the midst of a collapse") {
  for (const char* speed : {"2", "1e6"}) {
    Worker worker(60.0);
    worker.send(command::Open{load_scene("collapse", {{"view.speed", speed}})});
    wait_for_handled(worker, 1);
    std::this_thread::sleep_for(200ms);
    CHECK(worker.stop_within(100s));
  }
}

TEST_CASE("Worker: where it halts, a run without it has the same hash") {
  const Scene scene = scene_at_speed("vibrated", 20.0);
  Worker worker(60.0);
  worker.send(command::Open{scene, 23});
  for (std::uint64_t command = 2; command < 12; command += 2) {
    worker.send(command::Play{true});
    std::this_thread::sleep_for(20ms);
    if (command % 4 == 0) worker.send(command::StepCollision{});
    if (command % 4 != 0) worker.send(command::Play{false});
    const Frame halted = wait_for(worker, [&](const Frame& frame) {
      return frame.handled == command + 1 && frame.state_hash;
    });
    const auto simulation = simulation_of<2>(scene, 23);
    simulation->run_until(halted.snapshot.time);
    CHECK(simulation->state_hash() == *halted.state_hash);
  }
}
