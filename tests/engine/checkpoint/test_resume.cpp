// A resumed run equals the uninterrupted run, bit for bit.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/embedded_file.h"
#include "engine/error.h"
#include "engine/initial/start_state.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/gas.h"
#include "tests/support/temporary_folder.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

template <int D>
RunState<D> through_file(const Simulation<D>& simulation) {
  const TemporaryFolder folder;
  Checkpoint checkpoint;
  checkpoint.saved = simulation.save();
  write_checkpoint(folder / "a", checkpoint);
  return std::get<RunState<D>>(read_checkpoint(folder / "a").saved);
}

// Laws with a name, and their model.
struct Laws {
  std::string name;
  Model<2> model;
};

// At t = 0 and at t = 1e9 the walls are at their rest positions, after whole periods.
std::vector<Laws> all_laws() {
  Model<2> gas = periodic_box(20.0, 25.0);
  gas.restitution = 0.9;
  std::vector<Laws> laws = {
      {"cooling", gas},
      {"driven", with_walls(gas, 0, kDriven)},
      {"thermal", with_walls(gas, 1, kThermal)},
      {"sawtooth",
       with_walls(gas, 0, {.kind = WallKind::Sawtooth, .stroke = 0.3, .frequency = 1.75})},
      {"sinusoidal",
       with_walls(gas, 1, {.kind = WallKind::Sinusoidal, .stroke = 0.4, .frequency = 0.875})}};
  Model<2> model = with_walls(gas, 1, kDriven);
  model.gravity = {0.0, -0.1};
  laws.push_back({"gravity", model});
  model = gas;
  model.roughness = {.friction = 0.5, .tangential_restitution = 0.3};
  model.spins = true;
  laws.push_back({"rough", model});
  model = gas;
  model.bulk_drive = BulkDrive{.interval = 0.07, .kick_speed = 0.3};
  laws.push_back({"kicks", model});
  model = gas;
  model.contact_time = 0.02;
  laws.push_back({"t_c", model});
  // All at once.
  model = laws[4].model;
  model.walls[kLeft] = model.walls[kRight] = laws[3].model.walls[kLeft];
  model.walls[kLeft]->roughness.friction = 0.2;
  model.roughness = {.friction = 0.5, .tangential_restitution = 0.3};
  model.spins = true;
  model.gravity = {0.05, -0.1};
  model.bulk_drive = BulkDrive{.interval = 0.11, .kick_speed = 0.2, .kick_spin = 0.1};
  model.contact_time = 0.005;
  laws.push_back({"all", model});
  return laws;
}

}  // namespace

TEST_CASE("Resume: twenty halts in a run, across moves of the base, change no bit") {
  constexpr double kPart = 4.03125;
  for (const double start_time : {0.0, 1e9}) {
    for (const auto& [name, model] : all_laws()) {
      CAPTURE(name);
      CAPTURE(start_time);
      const State<2> start = random_gas(model, 100, 301);
      Simulation<2> straight(model, start, start_time);
      auto halted = std::make_unique<Simulation<2>>(model, start, start_time);
      int base_moves = 0;
      for (int part = 1; part <= 20; ++part) {
        straight.run_until(start_time + part * kPart);
        halted->run_until(start_time + part * kPart);
        const RunState<2> saved = through_file(*halted);
        base_moves += saved.now < kPart;
        halted = std::make_unique<Simulation<2>>(model, saved);
        REQUIRE(halted->state_hash() == straight.state_hash());
      }
      CHECK(base_moves > 0);
      CHECK(halted->time() == straight.time());
      CHECK(halted->counts().collisions() == straight.counts().collisions());
      CHECK(halted->counts().kicks == straight.counts().kicks);
      CHECK(halted->counts().elasticised == straight.counts().elasticised);
      CHECK(halted->counts().elasticised_wall == straight.counts().elasticised_wall);
      CHECK(halted->checks().deepest_overlap == straight.checks().deepest_overlap);
      check_sound(*halted);
    }
  }
}

TEST_CASE("Resume: a halt right after any collision changes no bit") {
  for (const auto& [name, model] : all_laws()) {
    CAPTURE(name);
    const State<2> start = random_gas(model, 30, 302);
    Simulation<2> straight(model, start);
    straight.run_until(kNever, 3000);
    auto halted = std::make_unique<Simulation<2>>(model, start);
    for (std::uint64_t collisions = 1; collisions <= 3000; ++collisions) {
      halted->run_until(kNever, collisions);
      halted = std::make_unique<Simulation<2>>(model, halted->save());
    }
    CHECK(halted->state_hash() == straight.state_hash());
    CHECK(halted->time() == straight.time());
  }
}

template <int D>
static void resume_halfway(const Scene& scene) {
  const Model<D> model = model_of<D>(scene, 1);
  Simulation<D> first(model, start_state<D>(scene, 1));
  first.run_until(kNever, 20 * static_cast<std::uint64_t>(scene.particles.count));
  const double halfway = first.time();
  first.run_until(halfway);
  Simulation<D> second(model, through_file(first));
  second.run_until(2.0 * halfway);
  Simulation<D> straight(model, start_state<D>(scene, 1));
  straight.run_until(2.0 * halfway);
  CHECK(second.state_hash() == straight.state_hash());
  CHECK(second.counts().pair_collisions > first.counts().pair_collisions);
}

TEST_CASE("Resume: every scene of the gallery continues from halfway to the same bits") {
  for (const EmbeddedFile& file : embedded_scenes()) {
    CAPTURE(file.name);
    const Scene scene = load_gallery_scene(file);
    with_dimension(scene.dimension(), [&](auto dimension) { resume_halfway<dimension>(scene); });
  }
}

// Positions and velocities differ by no more than the rounding error of an interrupted flight.
TEST_CASE("Resume: laws may change, and the particles stay where they are") {
  for (const auto& [before, old_model] : all_laws()) {
    Simulation<2> simulation(old_model, random_gas(old_model, 100, 303), 1e9);
    simulation.run_until(1e9 + 10.0);
    const State<2> state = simulation.state();
    for (const auto& [now, laws] : all_laws()) {
      CAPTURE(before);
      CAPTURE(now);
      // The walls keep their motion: with another motion they would overlap particles.
      Model<2> model = laws;
      model.walls = old_model.walls;
      Simulation<2> resumed(model, simulation.save());
      const State<2> taken_up = resumed.state();
      for (std::size_t i = 0; i < state.positions.size(); ++i) {
        REQUIRE((taken_up.positions[i] - state.positions[i]).norm() < 1e-12);
        REQUIRE((taken_up.velocities[i] - state.velocities[i]).norm() < 1e-12);
      }
      CHECK(taken_up.spins.size() == (model.spins || old_model.spins ? 100 : 0));
      const std::uint64_t kicks = resumed.counts().kicks;
      const double end = resumed.time() + 10.0;
      resumed.run_until(end);
      check_sound(resumed);
      const double interval = model.bulk_drive ? model.bulk_drive->interval : HUGE_VAL;
      CHECK(static_cast<double>(resumed.counts().kicks - kicks) ==
            doctest::Approx(10.0 / interval).epsilon(0.02));
    }
  }
}

TEST_CASE("Resume: kicks at another interval are counted from the time of resuming") {
  Model<2> model = periodic_box(20.0, 25.0);
  model.bulk_drive = BulkDrive{.interval = 0.5, .kick_speed = 0.1};
  Simulation<2> simulation(model, random_gas(model, 50, 304));
  simulation.run_until(10.25);
  CHECK(simulation.counts().kicks == 20);
  Simulation<2> same(model, simulation.save());
  same.run_until(10.375);
  CHECK(same.counts().kicks == 20);
  same.run_until(10.5);
  CHECK(same.counts().kicks == 21);
  model.bulk_drive->interval = 0.125;
  Simulation<2> other(model, simulation.save());
  other.run_until(10.375);
  CHECK(other.counts().kicks == 21);
  other.run_until(12.25);
  CHECK(other.counts().kicks == 36);
}

// Many dissipative particles: the first collapse comes after some hundred thousand collisions.
TEST_CASE("Resume: a run that collapsed continues with a contact time") {
  Model<2> model = periodic_box(20.0, 20.0);
  model.restitution = 0.1;
  Simulation<2> simulation(model, random_gas(model, 200, 305));
  std::string remedy;
  try {
    simulation.run_until(1e6);
  } catch (const PhysicalStop& stop) {
    remedy = stop.remedy();
  }
  REQUIRE(remedy.starts_with("collapse.contact_time="));
  const double end = 100.0 * simulation.time();
  CHECK_THROWS_AS(Simulation<2>(model, through_file(simulation)).run_until(end), PhysicalStop);
  model.contact_time = std::stod(remedy.substr(remedy.find('=') + 1));
  Simulation<2> resumed(model, through_file(simulation));
  CHECK(resumed.run_until(end));
  CHECK(resumed.time() == end);
  check_sound(resumed);
}

// A ball comes to rest on the floor. 64 runs move the base at different times, and one stops at a
// move.
TEST_CASE("Resume: a run that stops when its base should move can be resumed") {
  Model<2> model =
      with_walls(periodic_box(20.0, 20.0), 1, {.kind = WallKind::Static, .restitution = 0.5});
  model.gravity = {0.0, -1.0};
  RunState<2> saved = Simulation<2>(model, {{{5.0, 5.0}}, {{0.0, 0.0}}}).save();
  for (saved.until_base_moves = 1; saved.until_base_moves <= 64; ++saved.until_base_moves) {
    CAPTURE(saved.until_base_moves);
    Simulation<2> simulation(model, saved);
    CHECK_THROWS_AS(simulation.run_until(1e6), PhysicalStop);
    CHECK(simulation.save().until_base_moves > 0);
  }
}

TEST_CASE("Resume: overlaps that a run had do not keep it from continuing") {
  const Model<2> model = periodic_box(20.0, 20.0);
  RunState<2> saved =
      Simulation<2>(model, {{{5.0, 5.0}, {6.0, 5.0}}, {{0.0, 0.0}, {1.0, 0.0}}}).save();
  saved.flights[1].r.x() -= 1e-10;
  CHECK_THROWS_AS(Simulation<2>(model, saved), PhysicalStop);
  saved.checks.deepest_overlap = 2e-10;
  Simulation<2>(model, saved).run_until(1.0);
}
