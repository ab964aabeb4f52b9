// Gases that run in step: each has the bits of a run without the others.

#include <doctest/doctest.h>

#include <random>

#include "engine/error.h"
#include "engine/live/gases_in_step.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/support/scenes.h"
#include "tests/support/sliced_worker.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kStepSeed = 7;

// Disks between walls that move, under gravity, with kicks and a ramp.
Scene stepping_disks(double restitution) {
  Scene scene = gas(16.0, 18.0, 80, restitution);
  scene.gravity = Vec2(0.1, -0.3);
  scene.bulk_drive = BulkDrive{.interval = 0.37, .kick_speed = 0.5};
  scene.walls = {Wall{.kind = WallKind::Sawtooth, .stroke = 0.3, .frequency = 1.1},
                 Wall{.kind = WallKind::Thermal, .temperature = 4.0},
                 Wall{.kind = WallKind::Sinusoidal, .stroke = 0.4, .frequency = 0.8},
                 Wall{.kind = WallKind::Static, .restitution = 0.8}};
  scene.changes = {{.time = 12.0,
                    .set = {{"walls.right.temperature", "2"}},
                    .ramp = Ramp::Linear,
                    .until = 25.0}};
  return scene;
}

GasesInStep in_step(const std::vector<Scene>& scenes, std::size_t selected) {
  std::vector<std::unique_ptr<WatchedRun>> runs;
  std::vector<std::uint64_t> ids;
  for (const Scene& scene : scenes) {
    runs.push_back(watched_run(scene, kStepSeed));
    ids.push_back(10 + runs.size());
  }
  return {std::move(runs), std::move(ids), selected};
}

void run_in_step_to(GasesInStep& gases, double time) {
  while (gases.time() < time && !gases.run_until(time, kNoLimit, gases.counts().steps() + 100)) {
  }
}

Frame frame_in_step(GasesInStep& gases) {
  Frame frame;
  gases.fill(frame, true);
  return frame;
}

template <int D>
std::uint64_t hash_alone(const Scene& scene, double time) {
  ScheduledRun<D> run(scene, kStepSeed);
  run.run_until(time);
  return run.simulation().state_hash();
}

// Compares the state of each gas with that of a run of its scene and its changes alone.
void check_bits(const Frame& frame) {
  for (const Frame* gas : frames_of(frame)) {
    CAPTURE(gas->gas);
    CHECK(gas->snapshot.time == doctest::Approx(frame.snapshot.time).epsilon(1e-15));
    Scene scene = *gas->started;
    scene.changes = gas->scene->changes;
    const double time = gas->snapshot.time;
    const std::uint64_t alone =
        scene.dimension() == 2 ? hash_alone<2>(scene, time) : hash_alone<3>(scene, time);
    CHECK(gas->state_hash == alone);
  }
}

}  // namespace

TEST_CASE("Gases in step: a copy has the bits, the past and the sums of its original") {
  GasesInStep gases = in_step({stepping_disks(0.9)}, 0);
  run_in_step_to(gases, 20.0);
  gases.add_copy(5);
  const Frame copied = frame_in_step(gases);
  REQUIRE(copied.others.size() == 1);
  const Frame& copy = copied.others[0];
  CHECK(copied.gas == 0);
  CHECK(copied.id == 11);
  CHECK(copy.gas == 1);
  CHECK(copy.id == 5);
  CHECK(copy.state_hash == copied.state_hash);
  CHECK(copy.head == copied.head);
  CHECK(copy.tally.collisions == copied.tally.collisions);
  CHECK(copy.tally.dissipated == copied.tally.dissipated);
  CHECK(copy.record_bytes == copied.record_bytes);
  check_bits(copied);
  run_in_step_to(gases, 30.0);
  const Frame later = frame_in_step(gases);
  CHECK(later.others[0].state_hash == later.state_hash);
  CHECK(later.others[0].tally.dissipated == doctest::Approx(later.tally.dissipated).epsilon(1e-12));
  check_bits(later);
  // The past before the copy belongs to both.
  gases.go_back(7.0);
  run_in_step_to(gases, 7.0);
  check_bits(frame_in_step(gases));
}

TEST_CASE("Gases in step: a copy between two frames begins at the time of all") {
  GasesInStep gases = in_step({stepping_disks(0.9), stepping_disks(0.8)}, 0);
  REQUIRE_FALSE(gases.run_until(20.0, kNoLimit, 1000));
  gases.add_copy(2);
  Frame moving;
  gases.fill(moving, false);
  for (const Frame& other : moving.others) {
    CHECK(other.snapshot.time == doctest::Approx(moving.snapshot.time).epsilon(1e-15));
  }
  check_bits(frame_in_step(gases));
}

TEST_CASE("Gases in step: laws, nudges and futures concern the selected gas only") {
  GasesInStep gases = in_step({stepping_disks(0.9)}, 0);
  run_in_step_to(gases, 5.0);
  gases.add_copy(2);
  gases.select(1);
  gases.change({{"particles.restitution", "0.5"}}, 0.0);
  gases.nudge({.centre = Vec2(8.0, 9.0), .radius = 4.0, .add = Vec2(3.0, 1.0)}, 0.0);
  run_in_step_to(gases, 15.0);
  const Frame split = frame_in_step(gases);
  REQUIRE(split.gas == 1);
  const Frame& first = split.others[0];
  CHECK(first.scene->particles.restitution == 0.9);
  CHECK(split.scene->particles.restitution == 0.5);
  CHECK(first.scene->changes.size() == 1);
  CHECK(split.scene->changes.size() == 3);
  CHECK(first.state_hash != split.state_hash);
  check_bits(split);

  // Another future of the first gas. That of the second one stays.
  gases.select(0);
  gases.go_back(9.0);
  run_in_step_to(gases, 9.0);
  gases.change({{"particles.restitution", "0.7"}}, 0.0);
  run_in_step_to(gases, 15.0);
  const Frame forked = frame_in_step(gases);
  CHECK(forked.other_future.has_value());
  CHECK_FALSE(forked.others[0].other_future.has_value());
  CHECK(forked.state_hash != first.state_hash);
  CHECK(forked.others[0].state_hash == split.state_hash);
  check_bits(forked);
  run_in_step_to(gases, gases.exchange_futures());
  run_in_step_to(gases, 15.0);
  const Frame exchanged = frame_in_step(gases);
  CHECK(exchanged.state_hash == first.state_hash);
  CHECK(exchanged.others[0].state_hash == split.state_hash);
}

TEST_CASE("Gases in step: after jumps each gas has the bits of a run alone") {
  Scene spheres = rough_spheres(30);
  spheres.walls[1] = Wall{.kind = WallKind::Thermal, .temperature = 1.0};
  GasesInStep gases =
      in_step({stepping_disks(0.9), spheres, stepping_disks(0.6), stepping_disks(1.0)}, 2);
  run_in_step_to(gases, 40.0);
  check_bits(frame_in_step(gases));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.0, 40.0);
  for (int jump = 0; jump < 20; ++jump) {
    const double time = any(random);
    gases.select(static_cast<std::size_t>(jump) % 4);
    gases.go_back(time);
    run_in_step_to(gases, time);
    check_bits(frame_in_step(gases));
  }
  CHECK(gases.head() == doctest::Approx(40.0).epsilon(1e-15));
}

TEST_CASE("Gases in step: numbers follow a removal, identities stay") {
  GasesInStep gases = in_step({stepping_disks(0.9), stepping_disks(0.8), stepping_disks(0.7)}, 1);
  const auto told = [&] {
    std::vector<std::array<std::uint64_t, 2>> numbers;
    const Frame frame = frame_in_step(gases);
    for (const Frame* gas : frames_of(frame)) {
      CHECK(gas->scene->particles.restitution ==
            doctest::Approx(2.0 - 0.1 * static_cast<double>(gas->id)));
      numbers.push_back({gas->gas, gas->id});
    }
    numbers.push_back({frame.gas, frame.id});
    return numbers;
  };
  using Numbers = std::vector<std::array<std::uint64_t, 2>>;
  CHECK(told() == Numbers{{0, 11}, {1, 12}, {2, 13}, {1, 12}});
  gases.select(3);
  CHECK(told().back() == std::array<std::uint64_t, 2>{1, 12});
  gases.remove(0);
  CHECK(told() == Numbers{{0, 12}, {1, 13}, {0, 12}});
  gases.select(1);
  gases.remove(1);
  CHECK(told() == Numbers{{0, 12}, {0, 12}});
  gases.remove(0);
  CHECK(gases.count() == 1);
}

TEST_CASE("Gases in step: the fifth gas is refused, and the four stay") {
  SlicedWorker engine;
  execute(engine, command::Open{stepping_disks(0.9), kStepSeed, false});
  for (int copies = 1; copies < 4; ++copies) execute(engine, command::CopyGas{});
  const Frame& full = execute(engine, command::CopyGas{});
  CHECK(full.others.size() == 3);
  CHECK(says(full.message, "no more than 4 gases"));
}

TEST_CASE("Gases in step: all halt where a gas beside stops, and its letter is in the message") {
  const Scene collapsing = collapsing_gas();
  ScheduledRun<2> alone(collapsing, kStepSeed);
  CHECK_THROWS_AS(alone.run_until(1e4), PhysicalStop);
  const double stop = alone.simulation().time();

  SlicedWorker engine;
  command::Open open{stepping_disks(0.9), kStepSeed, false};
  open.others = {{collapsing, kStepSeed}};
  execute(engine, open);
  const Frame& halted = execute(engine, command::Jump{1e4});
  CHECK(halted.snapshot.time == 0.0);
  execute(engine, command::SetSpeed{100.0});
  const Frame& stopped = execute(engine, command::Play{true, 1e4});
  CHECK_FALSE(stopped.plays);
  CHECK(stopped.snapshot.time == doctest::Approx(stop).epsilon(1e-12));
  CHECK(stopped.others[0].snapshot.time == doctest::Approx(stop).epsilon(1e-15));
  CHECK(says(stopped.message, "gas B: "));
  // A contact time of the gas that stopped lets both continue.
  execute(engine, command::SelectGas{1});
  execute(engine, command::SetLaws{{{"collapse.contact_time", "0.01"}}});
  const Frame& later = execute(engine, command::Play{true, std::ceil(stop) + 2.0});
  const Frame& first = later.others[0];
  CHECK(first.snapshot.time == std::ceil(stop) + 2.0);
  CHECK(later.snapshot.time == doctest::Approx(first.snapshot.time).epsilon(1e-15));
  CHECK(first.state_hash == hash_alone<2>(*first.started, first.snapshot.time));
}

TEST_CASE("Gases in step: all halt where the selected gas stops") {
  GasesInStep gases = in_step({stepping_disks(0.9), collapsing_gas()}, 1);
  CHECK_THROWS_AS(gases.run_until(1e4, kNoLimit, kNoLimit), PhysicalStop);
  const Frame stopped = frame_in_step(gases);
  CHECK(stopped.snapshot.time > 0.0);
  CHECK(stopped.others[0].snapshot.time == doctest::Approx(stopped.snapshot.time).epsilon(1e-15));
}

TEST_CASE("Gases in step: steps to collisions are those of the selected gas") {
  SlicedWorker engine;
  command::Open open{stepping_disks(0.6), kStepSeed, false};
  open.others = {{stepping_disks(0.9), kStepSeed}};
  open.gas = 1;
  const Frame opened = execute(engine, open);
  CHECK(opened.gas == 1);
  CHECK(opened.scene->particles.restitution == 0.6);
  std::uint64_t collisions = opened.snapshot.collisions;
  for (int step = 0; step < 10; ++step) {
    const Frame& frame = execute(engine, command::StepCollision{});
    CHECK(frame.snapshot.collisions == ++collisions);
    CHECK(frame.partners.has_value());
    check_bits(frame);
  }
  execute(engine, command::Play{true, 3.0});
  const Frame& back = execute(engine, command::StepBack{});
  CHECK(back.snapshot.time < 3.0);
  check_bits(back);
  execute(engine, command::PlayBackwards{});
  engine.work(std::chrono::milliseconds(100));
  check_bits(execute(engine, command::Play{false}));
  // The marks of the pair end with another selection.
  execute(engine, command::StepCollision{});
  CHECK_FALSE(execute(engine, command::SelectGas{0}).partners.has_value());
}

TEST_CASE("Gases in step: each keeps its own particles in another box") {
  SlicedWorker engine;
  command::Open open{gas(10.0, 10.0, 30, 0.9), kStepSeed, false};
  open.others = {{gas(10.0, 10.0, 30, 0.5), kStepSeed}};
  execute(engine, open);
  execute(engine, command::SetSpeed{100.0});
  const Frame before = execute(engine, command::Play{true, 10.0});
  command::Open wider{gas(12.0, 10.0, 30, 0.9), kStepSeed, false, true, Vec2(1.0, 0.0)};
  wider.others = {{gas(11.0, 10.0, 30, 0.5), kStepSeed}};
  const Frame& kept = execute(engine, wider);
  const auto moved = [](const Frame& now, const Frame& then) {
    return (now.snapshot.positions - then.snapshot.positions).rowwise().mean().eval();
  };
  REQUIRE(kept.others.size() == 1);
  CHECK(kept.snapshot.velocities == before.snapshot.velocities);
  CHECK(kept.others[0].snapshot.velocities == before.others[0].snapshot.velocities);
  CHECK(kept.snapshot.velocities != kept.others[0].snapshot.velocities);
  CHECK(moved(kept, before).x() == doctest::Approx(1.0));
  CHECK(moved(kept.others[0], before.others[0]).x() == doctest::Approx(0.0));
}

TEST_CASE("Gases in step: a view reaches the gases of the selected one's dimension") {
  Scene spheres = rough_spheres(30);
  spheres.view.field = Field(Quantity::Density);
  GasesInStep gases = in_step({stepping_disks(0.9), stepping_disks(0.8), spheres}, 2);
  View view = spheres.view;
  view.field = Field(Quantity::Velocity, 2);
  gases.show(view);
  run_in_step_to(gases, 1.0);
  const Frame told = frame_in_step(gases);
  REQUIRE(told.snapshot.field);
  CHECK(told.snapshot.field->field == Field(Quantity::Velocity, 2));
  CHECK_FALSE(told.others[0].snapshot.field);
  gases.select(0);
  view.field = Field(Quantity::Temperature);
  gases.show(view);
  run_in_step_to(gases, 2.0);
  const Frame shown = frame_in_step(gases);
  REQUIRE(shown.others[0].snapshot.field);
  CHECK(shown.snapshot.field->field == Field(Quantity::Temperature));
  CHECK(shown.others[0].snapshot.field->field == Field(Quantity::Temperature));
  CHECK(shown.others[1].snapshot.field->field == Field(Quantity::Velocity, 2));
}

TEST_CASE("Gases in step: a field of a species is that of the same name, or none") {
  Scene mixture = stepping_disks(0.9);
  mixture.species.resize(2);
  for (Species& one : mixture.species) one.count = 40;
  mixture.species[0].name = "light";
  mixture.species[1].name = "heavy";
  Scene renamed = mixture;
  renamed.species[0].name = "heavy";
  renamed.species[1].name = "other";
  GasesInStep gases = in_step({mixture, stepping_disks(0.8), renamed}, 0);
  View view = mixture.view;
  view.field = Field(Quantity::Density).of(1);
  gases.show(view);
  run_in_step_to(gases, 0.5);
  const Frame frame = frame_in_step(gases);
  REQUIRE(frame.snapshot.field);
  CHECK(frame.snapshot.field->species == "heavy");
  CHECK_FALSE(frame.others[0].snapshot.field);
  REQUIRE(frame.others[1].snapshot.field);
  CHECK(frame.others[1].snapshot.field->field == Field(Quantity::Density).of(0));
  CHECK(frame.others[1].snapshot.field->species == "heavy");
}
