#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cmath>

#include "engine/live/worker.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/support/scenes.h"
#include "tests/support/sliced_worker.h"

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

// The hash of a run of a frame's scene and its changes alone, at the time of the frame.
template <int D>
std::uint64_t hash_without_worker(const Frame& frame, std::uint64_t seed) {
  Scene scene = *frame.started;
  scene.changes = frame.scene->changes;
  ScheduledRun<D> alone(parse_scene(scene_to_toml(scene), ""), seed);
  alone.run_until(frame.snapshot.time);
  return alone.simulation().state_hash();
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
  CHECK(there.snapshot.time == 1.25);
  CHECK(there.state_hash == hash_without_worker<3>(there, 26));
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
  SlicedWorker engine;
  execute(engine, command::Open{load_scene("vibrated"), 1, false});
  const Frame& frame = execute(engine, command::Open{rough_spheres(40), 27, false, true});
  CHECK(frame.message == "");
  CHECK(frame.state_hash == simulation_of<3>(rough_spheres(40), 27)->state_hash());
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
  CHECK(frame.state_hash == hash_without_worker<2>(frame, 22));
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
  CHECK(halted.state_hash == hash_without_worker<2>(halted, 1));

  std::vector<Change> changes = halted.scene->changes;
  changes.pop_back();
  worker.send(command::ReplaceChanges{changes, halted.scene->changes.back().time});
  const Frame undone = wait_for_handled(worker, 11);
  CHECK(undone.scene->changes == changes);
  CHECK(undone.snapshot.time == doctest::Approx(halted.scene->changes.back().time));
}

TEST_CASE("Worker: profiles and residuals come when asked for, and do not change the run") {
  Worker worker(60.0);
  worker.send(command::Open{scene_at_speed("vibrated", 50.0), 25});
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

  worker.send(command::ShowProfile{Profiled::Balances});
  const Frame balanced = wait_for(worker, [&](const Frame& frame) {
    return frame.residuals && !frame.residuals->residuals.equations.empty() &&
           frame.snapshot.time > shown.snapshot.time + 10.0;
  });
  CHECK_FALSE(balanced.profile);
  CHECK(balanced.residuals->residuals.equations[0].size() == 20);
  CHECK(balanced.residuals->width == doctest::Approx(balanced.snapshot.box.x() / 20.0));
  // As in measurements: not zero, but far below the effect of a missing event.
  const std::vector<double> largest = balanced.residuals->residuals.largest();
  CHECK(std::ranges::max(largest) < 1e-9);
  CHECK(largest[3] > 0.0);
  worker.send(command::ShowProfile{Profiled::Nothing});
  worker.send(command::Play{false});
  const Frame halted = wait_for_handled(worker, 5);
  CHECK_FALSE(halted.profile);
  CHECK_FALSE(halted.residuals);
  CHECK(halted.state_hash == hash_without_worker<2>(halted, 25));
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
  CHECK(halted.state_hash == hash_without_worker<2>(halted, 30));
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
  SlicedWorker engine;
  execute(engine, command::Open{scene, 1, false});
  Frame stopped;
  do {
    stopped = execute(engine, command::StepCollision{});
  } while (stopped.messages == 0);
  CHECK(stopped.snapshot.time == 0.05);
  CHECK(stopped.snapshot.collisions > 0);
  CHECK(says(stopped.message, "into a particle"));
  CHECK_FALSE(stopped.partners);
}

// An invalid law that comes into force with the very collision of the step.
TEST_CASE("Worker: a mistake found when it halts is reported, too") {
  Scene scene = load_scene("vibrated");
  const auto at_first_collision = [](const Scene& opened) {
    SlicedWorker engine;
    execute(engine, command::Open{opened, 1, false});
    return Frame(execute(engine, command::StepCollision{}));
  };
  const double time = at_first_collision(scene).snapshot.time;
  scene.changes = {{.time = time, .set = {{"particles.restitution", "7"}}}};
  const Frame there = at_first_collision(scene);
  CHECK(there.partners);
  CHECK(there.messages == 1);
  CHECK(says(there.message, "between 0 and 1"));
}

TEST_CASE("Worker: a gas that is kept starts with its own temperature") {
  SlicedWorker engine;
  execute(engine,
          command::Open{load_scene("vibrated", {{"particles.start.temperature", "4"}}), 1, false});
  const Frame& frame = execute(
      engine,
      command::Open{load_scene("vibrated", {{"box.size", "[20.0, 30.0]"}}), 1, false, true});
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
