// The clicks of a gas that plays, for its sound.

#include <doctest/doctest.h>

#include <algorithm>

#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/scenes.h"
#include "tests/support/sliced_worker.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

using Stretches = std::vector<std::shared_ptr<const PlayedStretch>>;

Scene heard_disks(double restitution = 0.9) {
  Scene scene = gas(12.0, 10.0, 30, restitution);
  scene.walls = {Wall{.kind = WallKind::Sawtooth, .stroke = 0.3, .frequency = 1.1},
                 Wall{.kind = WallKind::Static}, Wall{}, Wall{}};
  return scene;
}

// Executes a command until the gases halt, and adds the new stretches of all frames.
const Frame& execute_and_hear(SlicedWorker& engine, Command command, Stretches& heard) {
  engine.send(std::move(command));
  do {
    engine.work(std::chrono::milliseconds(5));
    engine.frames().update();
    for (const auto& stretch : engine.frames().front().played) {
      if (heard.empty() || stretch->number > heard.back()->number) heard.push_back(stretch);
    }
  } while (engine.busy());
  return engine.frames().front();
}

std::vector<Click> clicks_between(const Scene& scene, double from, double to) {
  ScheduledRun<2> run(scene, 1);
  ClickRecorder<2> recorder(run.simulation());
  run.run_until(from);
  recorder.take();
  run.run_until(to);
  CHECK(run.simulation().counts().collisions() > 20);
  return recorder.take();
}

// Checks that stretches follow each other from one time to another, with the clicks of a run.
void check_stretches(const Stretches& heard, const Scene& scene, double from, double to) {
  REQUIRE(heard.size() > 1);
  double time = from;
  std::vector<Click> clicks;
  for (const auto& stretch : heard) {
    CHECK(stretch->from == time);
    time = stretch->to;
    for (const Click& click : stretch->clicks) {
      CHECK(click.time >= stretch->from);
      CHECK(click.time <= stretch->to);
      clicks.push_back(click);
    }
  }
  CHECK(time == to);
  const std::vector<Click> expected = clicks_between(scene, from, to);
  REQUIRE(clicks.size() == expected.size());
  for (std::size_t k = 0; k < clicks.size(); ++k) {
    CHECK(clicks[k].time == doctest::Approx(expected[k].time).epsilon(1e-12));
    CHECK(clicks[k].frequency == doctest::Approx(expected[k].frequency).epsilon(1e-12));
    CHECK(clicks[k].energy == doctest::Approx(expected[k].energy).epsilon(1e-12));
    CHECK(clicks[k].place == doctest::Approx(expected[k].place).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("Listening: frames have the collisions of a gas that plays forwards, and no others") {
  SlicedWorker engine;
  Stretches heard;
  execute_and_hear(engine, command::Listen{true}, heard);
  execute_and_hear(engine, command::Open{heard_disks(), 1, false}, heard);
  execute_and_hear(engine, command::SetSpeed{20.0}, heard);
  CHECK(heard.empty());
  const Frame there = execute_and_hear(engine, command::Play{true, 3.0}, heard);
  CHECK(there.played.size() <= kMostStretches);
  check_stretches(heard, heard_disks(), 0.0, 3.0);
  ScheduledRun<2> unheard(heard_disks(), 1);
  unheard.run_until(3.0);
  CHECK(there.state_hash == unheard.simulation().state_hash());

  // Steps, jumps and the way backwards are silent.
  const std::size_t count = heard.size();
  execute_and_hear(engine, command::StepCollision{}, heard);
  execute_and_hear(engine, command::Step{0.5}, heard);
  execute_and_hear(engine, command::StepBack{}, heard);
  execute_and_hear(engine, command::Jump{2.0}, heard);
  execute_and_hear(engine, command::PlayBackwards{}, heard);
  execute_and_hear(engine, command::Jump{1.0}, heard);
  CHECK(heard.size() == count);
  execute_and_hear(engine, command::Play{true, 2.0}, heard);
  check_stretches({heard.begin() + static_cast<std::ptrdiff_t>(count), heard.end()}, heard_disks(),
                  1.0, 2.0);

  const Frame silent = execute_and_hear(engine, command::Listen{false}, heard);
  CHECK(silent.played.empty());
  CHECK(execute_and_hear(engine, command::Play{true, 4.0}, heard).played.empty());
}

TEST_CASE("Listening: the clicks are those of the selected gas") {
  const Scene other = heard_disks(0.6);
  SlicedWorker engine;
  Stretches heard, later;
  execute_and_hear(engine, command::Listen{true}, heard);
  execute_and_hear(
      engine, command::Open{.scene = heard_disks(), .plays = false, .others = {{other, 1}}}, heard);
  execute_and_hear(engine, command::SetSpeed{20.0}, heard);
  execute_and_hear(engine, command::Play{true, 2.0}, heard);
  check_stretches(heard, heard_disks(), 0.0, 2.0);
  execute_and_hear(engine, command::SelectGas{1}, heard);
  later = {heard.back()};
  execute_and_hear(engine, command::Play{true, 4.0}, later);
  later.erase(later.begin());
  check_stretches(later, other, 2.0, 4.0);
  later = {later.back()};
  execute_and_hear(engine, command::RemoveGas{1}, later);
  execute_and_hear(engine, command::Play{true, 6.0}, later);
  later.erase(later.begin());
  check_stretches(later, heard_disks(), 4.0, 6.0);
}

TEST_CASE("Listening: a stretch has the number of scenes and laws that the user has set") {
  SlicedWorker engine;
  Stretches heard;
  const auto laws_at = [&](double time) {
    execute_and_hear(engine, command::Play{true, time}, heard);
    return heard.back()->laws;
  };
  execute_and_hear(engine, command::Listen{true}, heard);
  execute_and_hear(engine, command::Open{heard_disks(), 1, false}, heard);
  const std::uint64_t first = laws_at(0.1);
  CHECK(laws_at(0.2) == first);
  execute_and_hear(engine, command::SetSpeed{2.0}, heard);
  CHECK(laws_at(0.3) == first);
  execute_and_hear(engine, command::SetLaws{{{"particles.restitution", "0.5"}}}, heard);
  const std::uint64_t second = laws_at(0.4);
  CHECK(second > first);
  execute_and_hear(engine, command::Open{heard_disks(), 1, false}, heard);
  CHECK(laws_at(0.1) > second);
}

TEST_CASE("Listening: of many clicks a bounded number remains, evenly and with their energy") {
  ScheduledRun<2> run(heard_disks(), 1);
  constexpr std::size_t kMost = 64;
  ClickRecorder<2> all(run.simulation()), some(run.simulation(), kMost);
  for (const double time : {50.0, 60.0}) {
    CAPTURE(time);
    run.run_until(time);
    const std::vector<Click> clicks = all.take(), kept = some.take();
    CHECK(clicks.size() > 40);
    // 1 of 2^k clicks remains, where kMost are reached for the last time at kMost 2^(k-1) clicks.
    std::size_t stride = 1;
    while (clicks.size() >= kMost * stride) stride *= 2;
    REQUIRE(kept.size() == clicks.size() / stride);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Click& original = clicks[stride * (k + 1) - 1];
      CHECK(kept[k].time == original.time);
      CHECK(kept[k].frequency == original.frequency);
      CHECK(kept[k].energy == static_cast<double>(stride) * original.energy);
    }
  }
}
