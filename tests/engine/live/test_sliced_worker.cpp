#include <doctest/doctest.h>

#include <thread>

#include "engine/live/worker.h"
#include "engine/scene/scene_file.h"

using namespace clatter;
using namespace std::chrono_literals;

// Works until a frame satisfies the condition; false after many slices.
static bool work_until(SlicedWorker& engine, const std::function<bool(const Frame&)>& holds) {
  for (int slice = 0; slice < 10'000; ++slice) {
    engine.work(2ms);
    engine.frames().update();
    if (holds(engine.frames().front())) return true;
  }
  return false;
}

TEST_CASE("SlicedWorker: a gas in slices has the state of the engine's thread") {
  const Scene scene = load_scene("vibrated");
  constexpr double kEnd = 3.0;

  SlicedWorker sliced;
  sliced.send(command::Open{scene, 1, false});
  sliced.send(command::SetSpeed{100.0});
  sliced.send(command::Play{true, kEnd});
  const auto halted = [](const Frame& frame) {
    return !frame.plays && frame.snapshot.time == kEnd;
  };
  REQUIRE(work_until(sliced, halted));
  const auto hash = sliced.frames().front().state_hash;
  REQUIRE(hash);

  Worker worker(60.0);
  worker.send(command::Open{scene, 1, false});
  worker.send(command::SetSpeed{100.0});
  worker.send(command::Play{true, kEnd});
  do {
    std::this_thread::sleep_for(1ms);
    worker.frames().update();
  } while (!halted(worker.frames().front()));
  CHECK(worker.frames().front().state_hash == hash);
}

TEST_CASE("SlicedWorker: a delay of more than 100 ms is dropped") {
  SlicedWorker engine;
  engine.send(command::Open{load_scene("vibrated"), 1, true});
  engine.send(command::SetSpeed{1.0});
  engine.work(1s);
  engine.frames().update();
  const double before = engine.frames().front().snapshot.time;
  std::this_thread::sleep_for(300ms);
  engine.work(1s);
  engine.frames().update();
  const double after = engine.frames().front().snapshot.time;
  CHECK(after > before);
  CHECK(after <= before + 0.1 + 1e-9);
}

// A gas whose start takes many slices.
static Scene large_scene() {
  return parse_scene("title = \"Large\"\nbox.size = [400.0, 600.0]\nparticles.count = 100000\n",
                     "large.toml");
}

TEST_CASE("SlicedWorker: a large scene opens in slices, and later commands wait for it") {
  SlicedWorker engine;
  engine.send(command::Open{large_scene(), 1, false});
  engine.send(command::SetLaws{{{"particles.restitution", "0.5"}}});
  int slices = 0;
  double progress = 0.0;
  REQUIRE(work_until(engine, [&](const Frame& frame) {
    ++slices;
    if (frame.opening) CHECK(*frame.opening >= progress);
    progress = frame.opening.value_or(progress);
    CHECK(engine.busy() == (frame.handled < 2));
    return frame.handled == 2;
  }));
  const Frame& frame = engine.frames().front();
  CHECK(slices > 1);
  CHECK(progress > 0.0);
  CHECK(frame.run == 1);
  CHECK(frame.snapshot.count() == 100'000);
  CHECK(frame.scene->particles.restitution == 0.5);
  CHECK_FALSE(frame.opening);
  CHECK(frame.messages == 0);
}

TEST_CASE("SlicedWorker: an opening that is cancelled, or followed by another, has no effect") {
  SlicedWorker engine;
  const auto handled = [](std::uint64_t count) {
    return [count](const Frame& frame) { return frame.handled == count; };
  };
  engine.send(command::Open{load_scene("vibrated"), 1, false});
  REQUIRE(work_until(engine, handled(1)));
  engine.send(command::Open{large_scene(), 1, false});
  engine.work(2ms);
  engine.frames().update();
  REQUIRE(engine.frames().front().opening);
  engine.send(command::SetLaws{{{"particles.restitution", "0.5"}}});
  engine.send(command::CancelOpen{});
  REQUIRE(work_until(engine, handled(4)));
  CHECK(engine.frames().front().run == 1);
  CHECK(engine.frames().front().scene->particles.restitution == 0.9);
  CHECK_FALSE(engine.frames().front().opening);
  CHECK_FALSE(engine.busy());

  engine.send(command::Open{large_scene(), 1, false});
  engine.work(2ms);
  engine.send(command::Open{load_scene("cradle"), 1, false});
  REQUIRE(work_until(engine, handled(6)));
  CHECK(engine.frames().front().run == 2);
  CHECK(engine.frames().front().scene->title == load_scene("cradle").title);
}

TEST_CASE("SlicedWorker: a large gas gets short slices after a small gas") {
  SlicedWorker engine;
  engine.send(command::Open{load_scene("cradle"), 1, true});
  for (int slice = 0; slice < 50; ++slice) engine.work(2ms);
  engine.send(command::Open{large_scene(), 1, true});
  engine.send(command::SetSpeed{1000.0});
  REQUIRE(work_until(engine, [](const Frame& frame) { return frame.handled == 3; }));
  std::this_thread::sleep_for(10ms);
  engine.work(0ms);
  engine.frames().update();
  const Frame& frame = engine.frames().front();
  CHECK(frame.snapshot.time > 0.0);
  CHECK(frame.snapshot.collisions < 10'000);
}

TEST_CASE("SlicedWorker: a large gas goes to another time in slices, and commands wait for it") {
  SlicedWorker engine;
  engine.send(command::Open{large_scene(), 1, false});
  engine.send(command::SetSpeed{100.0});
  engine.send(command::Play{true, 1.0});
  const auto at = [](double time) {
    return [time](const Frame& frame) { return !frame.plays && frame.snapshot.time == time; };
  };
  REQUIRE(work_until(engine, at(1.0)));
  const auto hash = engine.frames().front().state_hash;

  // No frame shows a time on the way.
  engine.send(command::Jump{0.9});
  int slices = 0;
  REQUIRE(work_until(engine, [&](const Frame& frame) {
    ++slices;
    CHECK((frame.snapshot.time == 0.9 || frame.snapshot.time == 1.0));
    CHECK(engine.busy() == (frame.snapshot.time == 1.0));
    return frame.snapshot.time == 0.9;
  }));
  CHECK(slices > 1);
  // A later jump ends an earlier one.
  engine.send(command::Jump{0.7});
  engine.work(2ms);
  engine.send(command::Jump{1.0});
  REQUIRE(work_until(engine, [](const Frame& frame) {
    CHECK((frame.snapshot.time == 0.9 || frame.snapshot.time == 1.0));
    return frame.snapshot.time == 1.0;
  }));
  CHECK(engine.frames().front().state_hash == hash);

  engine.send(command::Jump{0.5});
  engine.send(command::SetLaws{{{"particles.restitution", "0.5"}}});
  REQUIRE(work_until(engine, [](const Frame& frame) { return !frame.scene->changes.empty(); }));
  CHECK(engine.frames().front().scene->changes.front().time == doctest::Approx(0.5).epsilon(0.5));
  CHECK(engine.frames().front().head < 1.0);
}

TEST_CASE("SlicedWorker: a step back in a large gas is made in slices, to the bit") {
  SlicedWorker engine;
  engine.send(command::Open{large_scene(), 1, false});
  engine.send(command::Step{0.5});
  REQUIRE(work_until(engine, [](const Frame& frame) { return frame.snapshot.time == 0.5; }));
  engine.send(command::StepCollision{});
  REQUIRE(work_until(engine, [](const Frame& frame) { return frame.partners.has_value(); }));
  const auto [partners, hash] =
      std::pair(engine.frames().front().partners, engine.frames().front().state_hash);
  engine.send(command::StepCollision{});
  REQUIRE(work_until(
      engine, [&](const Frame& frame) { return frame.partners && frame.partners != partners; }));
  engine.send(command::StepBack{});
  int slices = 0;
  REQUIRE(work_until(engine, [&](const Frame& frame) {
    ++slices;
    return frame.partners == partners;
  }));
  CHECK(slices > 1);
  CHECK(engine.frames().front().state_hash == hash);
}

TEST_CASE("SlicedWorker: the next collision in a large gas is searched in slices") {
  SlicedWorker engine;
  engine.send(command::Open{large_scene(), 1, false});
  REQUIRE(work_until(engine, [](const Frame& frame) { return frame.handled == 1; }));
  engine.send(command::Pick{7});
  int slices = 0;
  REQUIRE(work_until(engine, [&](const Frame& frame) {
    ++slices;
    CHECK(engine.busy() == !frame.next_collision);
    return frame.next_collision.has_value();
  }));
  CHECK(slices > 1);
}
