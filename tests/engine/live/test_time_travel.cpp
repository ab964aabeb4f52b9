#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>
#include <random>

#include "engine/error.h"
#include "engine/live/rewinder.h"
#include "engine/live/watched_run.h"
#include "engine/live/worker.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/scenes.h"
#include "tests/support/sliced_worker.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kTravelSeed = 5;

void run_to(WatchedRun& run, double time) {
  while (run.time() < time && !run.run_until(time, kNoLimit, run.counts().steps() + 1000)) {
  }
}

void go_to(WatchedRun& run, double time) {
  run.go_back(time);
  run_to(run, time);
}

Frame frame_of(WatchedRun& run) {
  Frame frame;
  run.fill(frame, true);
  return frame;
}

std::uint64_t hash_of(WatchedRun& run) {
  return *frame_of(run).state_hash;
}

// The hashes at these times of a run of the scene without jumps.
template <int D>
std::map<double, std::uint64_t> fresh_hashes(const Scene& scene, std::vector<double> times) {
  std::ranges::sort(times);
  ScheduledRun<D> fresh(scene, kTravelSeed);
  std::map<double, std::uint64_t> hashes;
  for (const double time : times) {
    fresh.run_until(time);
    hashes[time] = fresh.simulation().state_hash();
  }
  return hashes;
}

// A scene with the changes of a run.
Scene with_changes_of(Scene scene, WatchedRun& run) {
  scene.changes = frame_of(run).scene->changes;
  return scene;
}

// Disks between moving and thermal walls under gravity, with kicks and changes of laws.
Scene driven_disks() {
  Scene scene = gas(16.0, 18.0, 120, 0.9);
  scene.gravity = Vec2(0.0, -0.3);
  scene.bulk_drive = BulkDrive{.interval = 0.37, .kick_speed = 0.5};
  scene.walls = {Wall{.kind = WallKind::Sawtooth, .stroke = 0.3, .frequency = 1.1},
                 Wall{.kind = WallKind::Thermal, .temperature = 4.0},
                 Wall{.kind = WallKind::Sinusoidal, .stroke = 0.4, .frequency = 0.8},
                 Wall{.kind = WallKind::Static, .restitution = 0.8}};
  scene.changes = {{.time = 30.0, .set = {{"walls.bottom.frequency", "1.3"}}},
                   {.time = 100.0,
                    .set = {{"particles.restitution", "0.7"}},
                    .ramp = Ramp::Linear,
                    .until = 220.0}};
  return scene;
}

// A gas in a sheared box, with kicks and changes of the rate.
Scene sheared_disks() {
  Scene scene = gas(16.0, 18.0, 120, 0.9);
  scene.shear_rate = 0.7;
  scene.bulk_drive = BulkDrive{.interval = 0.37, .kick_speed = 0.5};
  scene.changes = {
      {.time = 30.0, .set = {{"shear.rate", "-0.4"}}},
      {.time = 100.0, .set = {{"shear.rate", "1.0"}}, .ramp = Ramp::Linear, .until = 220.0}};
  return scene;
}

// Changes a law, jumps to random times of a run, and compares its states with those of a run
// without jumps. The record of the run has at least `states`.
template <int D>
void check_jumps(const Scene& scene, std::size_t record_bytes, std::size_t states) {
  constexpr double kEnd = 300.0;
  const auto run = watched_run(scene, kTravelSeed, record_bytes);
  run_to(*run, 150.0);
  run->change({{"particles.restitution", "0.8"}}, 0.0);
  run_to(*run, kEnd);
  const std::size_t bytes = frame_of(*run).record_bytes;
  CHECK(bytes <= record_bytes);
  CHECK(bytes >= states * static_cast<std::size_t>(scene.particles.count) * sizeof(Flight<D>));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0.0, kEnd);
  std::vector<double> times(100);
  std::ranges::generate(times, [&] { return any(random); });
  auto hashes = fresh_hashes<D>(with_changes_of(scene, *run), times);
  for (const double time : times) {
    go_to(*run, time);
    CHECK(run->time() == doctest::Approx(time).epsilon(1e-15));
    REQUIRE(hash_of(*run) == hashes[time]);
  }
  CHECK(run->head() == doctest::Approx(kEnd).epsilon(1e-15));
  run_to(*run, kEnd + 2.0);
  CHECK(hash_of(*run) == fresh_hashes<D>(with_changes_of(scene, *run), {kEnd + 2.0})[kEnd + 2.0]);
}

}  // namespace

TEST_CASE("Time travel: after 100 jumps disks have the states of a run without jumps") {
  check_jumps<2>(driven_disks(), kRecordBytes, 10);
  check_jumps<2>(driven_disks(), 50'000, 3);  // memory for a few states
}

TEST_CASE("Time travel: after 100 jumps sheared disks have the states of a run without jumps") {
  check_jumps<2>(sheared_disks(), kRecordBytes, 10);
}

TEST_CASE("Time travel: after 100 jumps rough spheres have the states of a run without jumps") {
  Scene scene = rough_spheres(40);
  scene.walls[1] = Wall{.kind = WallKind::Thermal, .temperature = 1.0};
  scene.changes = {{.time = 40.0, .set = {{"walls.left.drive_speed", "0.5"}}}};
  check_jumps<3>(scene, kRecordBytes, 4);
}

namespace {

// A change of a law at t = 10, then the run continues to t = 20. Then the run goes back to
// t = 8.
std::unique_ptr<WatchedRun> changed_run(const Scene& scene) {
  auto run = watched_run(scene, kTravelSeed);
  run_to(*run, 10.0);
  run->change({{"particles.restitution", "0.5"}}, 0.0);
  run_to(*run, 20.0);
  go_to(*run, 8.0);
  return run;
}

template <int D>
std::uint64_t fresh_hash(const Scene& scene, double time) {
  return fresh_hashes<D>(scene, {time})[time];
}

// Runs until the run stops by itself; returns the time of the stop.
double run_to_stop(WatchedRun& run) {
  CHECK_THROWS_AS(run_to(run, 1e4), PhysicalStop);
  return run.time();
}

}  // namespace

TEST_CASE("Time travel: a change in the past begins another future, and the old one remains") {
  const Scene scene = driven_disks();
  const auto run = changed_run(scene);
  const Scene old = with_changes_of(scene, *run);
  run->change({{"gravity.acceleration", "[0.0, -2.0]"}}, 0.0);
  Frame frame = frame_of(*run);
  CHECK(run->head() == run->time());
  CHECK(frame.futures == 1);
  CHECK(frame.scene->changes.size() == 3);  // two of the scene
  REQUIRE(frame.other_future);
  CHECK((*frame.other_future)[0] == doctest::Approx(8.0));
  CHECK((*frame.other_future)[1] == doctest::Approx(20.0));
  const Scene now = with_changes_of(scene, *run);
  run_to(*run, 15.0);
  CHECK(hash_of(*run) == fresh_hash<2>(now, 15.0));
  CHECK(hash_of(*run) != fresh_hash<2>(old, 15.0));

  run_to(*run, run->exchange_futures());
  CHECK(run->time() == doctest::Approx(8.0));
  CHECK(run->head() == doctest::Approx(20.0));
  frame = frame_of(*run);
  CHECK((*frame.other_future)[1] == doctest::Approx(15.0));
  go_to(*run, 20.0);
  CHECK(hash_of(*run) == fresh_hash<2>(old, 20.0));
  run_to(*run, 25.0);
  CHECK(hash_of(*run) == fresh_hash<2>(old, 25.0));

  run_to(*run, run->exchange_futures());
  go_to(*run, run->head());
  CHECK(run->time() == doctest::Approx(15.0));
  CHECK(hash_of(*run) == fresh_hash<2>(now, run->time()));
}

TEST_CASE("Time travel: a change at time 0 replaces the whole future") {
  const Scene scene = driven_disks();
  const auto run = changed_run(scene);
  const Scene old = with_changes_of(scene, *run);
  go_to(*run, 0.0);
  run->change({{"particles.restitution", "0.6"}}, 0.0);
  run_to(*run, 5.0);
  CHECK(hash_of(*run) == fresh_hash<2>(with_changes_of(scene, *run), 5.0));
  go_to(*run, 1.0);
  CHECK(hash_of(*run) == fresh_hash<2>(with_changes_of(scene, *run), 1.0));
  run_to(*run, run->exchange_futures());
  CHECK(run->time() == 0.0);
  run_to(*run, 12.0);
  CHECK(hash_of(*run) == fresh_hash<2>(old, 12.0));
}

TEST_CASE("Time travel: a change that is moved takes effect at its new time") {
  const Scene scene = driven_disks();
  for (const double to : {5.0, 14.0, 20.5}) {
    const auto run = changed_run(scene);
    const Scene old = with_changes_of(scene, *run);
    REQUIRE(old.changes[2].time == doctest::Approx(10.0));
    const double begin = run->move_change(2, to);
    run_to(*run, begin);
    CHECK(begin == doctest::Approx(std::min(10.0, to)));
    CHECK(run->head() == doctest::Approx(begin));
    const Scene now = with_changes_of(scene, *run);
    CHECK(now.changes[2].time == to);
    run_to(*run, 21.0);
    CHECK(frame_of(*run).scene->particles.restitution == doctest::Approx(0.5));
    CHECK(hash_of(*run) == fresh_hash<2>(now, 21.0));
    go_to(*run, 12.0);
    CHECK(hash_of(*run) == fresh_hash<2>(now, 12.0));
    run_to(*run, run->exchange_futures());
    run_to(*run, 20.0);
    CHECK(hash_of(*run) == fresh_hash<2>(old, 20.0));
  }
}

TEST_CASE("Time travel: a ramp that is moved keeps its duration") {
  const Scene scene = driven_disks();
  const auto run = watched_run(scene, kTravelSeed);
  run_to(*run, 160.0);  // amid the ramp
  run_to(*run, run->move_change(1, 120.0));
  const Scene now = with_changes_of(scene, *run);
  CHECK(now.changes[1].time == 120.0);
  CHECK(now.changes[1].until == 240.0);
  run_to(*run, 180.0);
  CHECK(hash_of(*run) == fresh_hash<2>(now, 180.0));
}

TEST_CASE("Time travel: refused changes keep the future") {
  const Scene scene = driven_disks();
  const auto run = changed_run(scene);
  const Scene old = with_changes_of(scene, *run);
  CHECK_THROWS_AS(run->change({{"box.size", "[30.0, 30.0]"}}, 0.0), UserError);
  CHECK_THROWS_AS(run->move_change(3, 5.0), UserError);  // no such change
  CHECK_THROWS_AS(run->move_change(2, 0.0), UserError);
  CHECK_THROWS_AS(watched_run(scene, kTravelSeed)->move_change(0, 5.0), UserError);
  CHECK(run->head() == doctest::Approx(20.0));
  CHECK_FALSE(frame_of(*run).other_future);
  CHECK_THROWS_AS(run->exchange_futures(), UserError);
  run_to(*run, 20.0);
  CHECK(hash_of(*run) == fresh_hash<2>(old, 20.0));
}

TEST_CASE("Time travel: the other future gives way if memory is short") {
  const Scene scene = driven_disks();
  const auto run = watched_run(scene, kTravelSeed, 50'000);
  run_to(*run, 100.0);
  go_to(*run, 50.0);
  run->change({{"particles.restitution", "0.5"}}, 0.0);
  CHECK(frame_of(*run).other_future);
  run_to(*run, 300.0);
  CHECK_FALSE(frame_of(*run).other_future);
  CHECK(frame_of(*run).record_bytes <= 50'000);
  CHECK(hash_of(*run) == fresh_hash<2>(with_changes_of(scene, *run), 300.0));
}

TEST_CASE("Time travel: sums and rotations at a time are those of the first pass") {
  Scene scene = rough_spheres(40);
  scene.walls[1] = Wall{.kind = WallKind::Thermal, .temperature = 1.0};
  const auto run = watched_run(scene, kTravelSeed);
  run_to(*run, 60.0);
  run->change({{"particles.restitution", "0.85"}}, 0.0);  // a recorded state
  run_to(*run, 120.0);
  const Frame first = frame_of(*run);
  run_to(*run, 140.0);
  go_to(*run, 120.0);
  const Frame again = frame_of(*run);
  CHECK(again.tally.time == doctest::Approx(first.tally.time).epsilon(1e-12));
  CHECK(again.tally.collisions == first.tally.collisions);
  CHECK(again.tally.dissipated == doctest::Approx(first.tally.dissipated).epsilon(1e-10));
  CHECK(again.tally.walls_in == doctest::Approx(first.tally.walls_in).epsilon(1e-10));
  REQUIRE(again.snapshot.orientations.size() == 40);
  for (std::size_t i = 0; i < 40; ++i) {
    CHECK(again.snapshot.orientations[i].angularDistance(first.snapshot.orientations[i]) < 1e-6);
  }
}

// A dragged slider makes many changes, and a copy of the state at each would take time and memory.
TEST_CASE("Time travel: changes in succession add few states, and jumps make them again") {
  const Scene scene = driven_disks();
  const auto run = watched_run(scene, kTravelSeed);
  run_to(*run, 20.0);
  const std::size_t before = frame_of(*run).record_bytes;
  for (int k = 0; k < 30; ++k) {
    run->change({{"particles.restitution", fmt::format("{}", 0.9 - 0.01 * k)}}, 0.0);
    run_to(*run, 20.0 + 0.01 * (k + 1));
  }
  CHECK(frame_of(*run).record_bytes < before + 3 * 120 * sizeof(Flight<2>));
  const std::uint64_t hash = hash_of(*run);
  const Scene changed = with_changes_of(scene, *run);
  CHECK(changed.changes.size() == 32);
  go_to(*run, 20.15);
  CHECK(hash_of(*run) == fresh_hash<2>(changed, 20.15));
  CHECK(frame_of(*run).scene->particles.restitution == doctest::Approx(0.76));
  go_to(*run, run->head());
  CHECK(hash_of(*run) == hash);
}

TEST_CASE("Time travel: a run that stopped by itself returns to its stop, and continues after it") {
  const auto run = watched_run(collapsing_gas(), kTravelSeed);
  const double stop = run_to_stop(*run);
  const std::uint64_t hash = hash_of(*run);
  CHECK(frame_of(*run).stops == std::vector<double>{stop});
  go_to(*run, 0.5 * stop);
  go_to(*run, run->head());
  CHECK(run->time() == doctest::Approx(stop).epsilon(1e-15));
  CHECK(hash_of(*run) == hash);
  run->change({{"collapse.contact_time", "0.01"}}, 0.0);
  run_to(*run, stop + 5.0);
  const std::uint64_t later = hash_of(*run);
  go_to(*run, 0.9 * stop);
  run_to(*run, stop + 5.0);
  CHECK(hash_of(*run) == later);
}

TEST_CASE("Time travel: steps back pass the collisions of the steps forth") {
  Scene scene = driven_disks();
  SlicedWorker engine;
  execute(engine, command::Open{scene, kTravelSeed, false});
  std::vector<Frame> steps = {execute(engine, command::Jump{0.0})};
  for (int step = 0; step < 20; ++step) steps.push_back(execute(engine, command::StepCollision{}));
  for (std::size_t step = 19; step >= 1; --step) {
    const Frame& back = execute(engine, command::StepBack{});
    CHECK(back.message == "");
    CHECK(back.snapshot.collisions == steps[step].snapshot.collisions);
    CHECK(back.state_hash == steps[step].state_hash);
    CHECK(back.partners == steps[step].partners);
  }
  CHECK(execute(engine, command::StepBack{}).snapshot.time == 0.0);
  CHECK(execute(engine, command::StepBack{}).snapshot.time == 0.0);
}

TEST_CASE("Time travel: jumps, futures and steps in any order keep the bits of their scene") {
  const Scene scene = driven_disks();
  SlicedWorker engine;
  execute(engine, command::Open{scene, kTravelSeed, false});
  engine.send(command::SetSpeed{200.0});
  execute(engine, command::Play{true, 20.0});
  std::mt19937 random(2);
  int futures = 0;
  for (int action = 0; action < 100; ++action) {
    const auto any = [&](double end) {
      return std::uniform_real_distribution<double>(0.0, end)(random);
    };
    Frame frame = execute(engine, command::Jump{any(25.0)});
    switch (random() % 5) {
      case 0:
        frame = execute(engine, command::StepBack{});
        break;
      case 1:
        frame = execute(engine, command::StepCollision{});
        break;
      case 2:
        frame = execute(
            engine, command::SetLaws{{{"particles.restitution", std::to_string(0.5 + any(0.5))}}});
        break;
      case 3:
        if (frame.other_future) frame = execute(engine, command::ExchangeFutures{});
        break;
      default:
        frame = execute(engine, command::Play{true, frame.snapshot.time + any(5.0)});
    }
    CHECK(frame.message == "");
    futures = static_cast<int>(frame.futures);
    Scene played = scene;
    played.changes = frame.scene->changes;
    REQUIRE(frame.state_hash == fresh_hash<2>(played, frame.snapshot.time));
  }
  CHECK(futures > 10);
}

TEST_CASE("Time travel: backwards, each frame is that of the run at its time") {
  Scene scene = driven_disks();
  scene.view.trails = 0.5;
  const auto run = changed_run(scene);
  const Scene played = with_changes_of(scene, *run);
  constexpr double kInterval = 0.0625;
  go_to(*run, 12.0);
  Rewinder rewinder(*run, kInterval);
  for (int number = 1; number <= 192; ++number) {
    const double time = 12.0 - number * kInterval;
    std::optional<Frame> frame;
    while (!(frame = rewinder.take(time))) rewinder.work({});
    REQUIRE(frame->snapshot.time == doctest::Approx(time).epsilon(1e-14));
    CHECK_FALSE(rewinder.due(time));
    if (number % 16 != 0) continue;
    ScheduledRun<2> fresh(played, kTravelSeed);
    fresh.run_until(time);
    CHECK(frame->snapshot.positions == fresh.snapshot().positions);
    CHECK(frame->snapshot.velocities == fresh.snapshot().velocities);
    CHECK(frame->scene->particles.restitution == (time <= 10.0 ? 0.9 : 0.5));
    CHECK(frame->head == doctest::Approx(20.0));
  }
  CHECK_FALSE(rewinder.busy());
  CHECK_FALSE(rewinder.take(-1.0));
}

TEST_CASE("Time travel: frames that are late are left out") {
  const auto run = changed_run(driven_disks());
  Rewinder rewinder(*run, 1.0);
  while (rewinder.busy()) rewinder.work({});
  CHECK(rewinder.take(5.2)->snapshot.time == doctest::Approx(5.0));
  CHECK(rewinder.take(0.0)->snapshot.time == doctest::Approx(4.0));  // the earliest one made so far
  while (rewinder.busy()) rewinder.work({});
  CHECK(rewinder.take(0.0)->snapshot.time == 0.0);
}

TEST_CASE("Time travel: a gas plays backwards, halts to the bit, and reaches the start") {
  const Scene scene = driven_disks();
  for (const bool changes_view : {false, true}) {
    SlicedWorker engine;
    execute(engine, command::Open{scene, kTravelSeed, false});
    engine.send(command::SetSpeed{20.0});
    const double head = execute(engine, command::Play{true, 20.0}).snapshot.time;
    engine.send(command::PlayBackwards{});
    const auto rewind_below = [&](double time) {
      while (engine.frames().front().snapshot.time >= time) {
        engine.work(std::chrono::milliseconds(2));
        engine.frames().update();
      }
    };
    rewind_below(12.0);
    CHECK(engine.frames().front().backwards);
    if (changes_view) engine.send(command::Show{scene.view});
    if (changes_view) rewind_below(10.0);
    const Frame halted = execute(engine, command::Play{false});
    CHECK_FALSE(halted.plays);
    CHECK(halted.head == head);
    CHECK(halted.state_hash == fresh_hash<2>(scene, halted.snapshot.time));
    const Frame start = execute(engine, command::PlayBackwards{});
    CHECK(start.snapshot.time == 0.0);
    CHECK(start.state_hash);
    CHECK_FALSE(start.plays);
    CHECK_FALSE(execute(engine, command::PlayBackwards{}).plays);
    const Frame again = execute(engine, command::Jump{head});
    CHECK(again.state_hash == fresh_hash<2>(scene, again.snapshot.time));
  }
}

TEST_CASE("Time travel: a stretch repeats until it has no length") {
  const Scene scene = driven_disks();
  SlicedWorker engine;
  execute(engine, command::Open{scene, kTravelSeed, false});
  engine.send(command::SetSpeed{100.0});
  execute(engine, command::Play{true, 20.0});
  engine.send(command::Loop{5.0, 8.0});
  engine.send(command::Jump{4.0});
  engine.send(command::Play{});
  double latest = 0.0;
  for (int turns = 0; turns < 3;) {
    const double before = engine.frames().front().snapshot.time;
    engine.work(std::chrono::milliseconds(5));
    engine.frames().update();
    const Frame& frame = engine.frames().front();
    REQUIRE(frame.message == "");
    CHECK(frame.held >= 0.0);
    if (before < 8.0) latest = std::max(latest, frame.snapshot.time);
    if (frame.loop && before < 9.0 && frame.snapshot.time < before) {
      CHECK(frame.snapshot.time == doctest::Approx(5.0));
      ++turns;
    }
  }
  CHECK(latest < 8.0);
  const Frame halted = execute(engine, command::Play{false});
  CHECK(halted.head == doctest::Approx(20.0));
  CHECK(halted.state_hash == fresh_hash<2>(scene, halted.snapshot.time));
  engine.send(command::Loop{});
  CHECK(execute(engine, command::Play{true, 12.0}).snapshot.time == 12.0);
}
