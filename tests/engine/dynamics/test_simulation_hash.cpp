#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

std::vector<Model<2>> models() {
  std::vector<Model<2>> models = {
      periodic_box(20.0, 25.0), with_walls(periodic_box(20.0, 25.0), 0, kDriven),
      with_walls(with_walls(periodic_box(20.0, 25.0), 0, kDriven), 1, kThermal)};
  for (Model<2>& model : models) model.restitution = 0.95;
  return models;
}

// Particles on a square lattice, many with equal velocities: hundreds of simultaneous collisions.
State<2> symmetric_start() {
  State<2> start;
  for (int i = 0; i < 100; ++i) {
    const Vec2 directions[] = {{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}};
    start.positions.push_back({1.0 + 2.0 * (i % 10), 1.25 + 2.5 * (i / 10)});
    start.velocities.push_back(directions[(i + i / 10) % 4]);
  }
  return start;
}

std::uint64_t hash_with_frames(const Model<2>& model, const State<2>& start, int frames_per_time) {
  constexpr double kEnd = 50.0;
  Simulation<2> simulation(model, start);
  for (int i = 1; i <= frames_per_time * kEnd; ++i) {
    simulation.run_until(static_cast<double>(i) / frames_per_time);
    REQUIRE(simulation.state().positions.size() == start.positions.size());
  }
  simulation.run_until(kEnd);
  check_sound(simulation);
  return simulation.state_hash();
}

}  // namespace

TEST_CASE("State hash: it is the same at 0, 30 and 240 frames per unit of time") {
  for (const Model<2>& model : models()) {
    for (const State<2>& start : {random_gas(model, 150, 101), symmetric_start()}) {
      const std::uint64_t plain = hash_with_frames(model, start, 0);
      CHECK(hash_with_frames(model, start, 30) == plain);
      CHECK(hash_with_frames(model, start, 240) == plain);
    }
  }
}

TEST_CASE("State hash: it is the same with timers, observers and halts at every collision") {
  for (const Model<2>& model : models()) {
    const State<2> start = random_gas(model, 150, 102);
    const std::uint64_t plain = hash_with_frames(model, start, 0);
    Simulation<2> watched(model, start);
    Observer<2> observer;
    watched.add_observer(observer);
    double energy = 0.0;
    watched.every(0.01, 0.013, [&](double) { energy += watched.kinetic_energy(); });
    for (std::uint64_t i = 1; i <= 500; ++i) watched.run_until(kNever, i);
    REQUIRE(watched.time() < 50.0);
    watched.run_until(50.0);
    CHECK(watched.state_hash() == plain);
  }
}

TEST_CASE("State hash: any change of any number changes it, but the sign of a zero does not") {
  const Model<2> model = periodic_box(20.0, 25.0);
  const State<2> state = random_gas(model, 20, 105);
  const std::uint64_t hash = state_hash<2>(state);
  for (std::size_t i = 0; i < 20; ++i) {
    for (int k = 0; k < 2; ++k) {
      State<2> moved = state, pushed = state;
      moved.positions[i][k] = std::nextafter(moved.positions[i][k], 0.0);
      pushed.velocities[i][k] = -pushed.velocities[i][k];
      CHECK(state_hash<2>(moved) != hash);
      CHECK(state_hash<2>(pushed) != hash);
    }
  }
  State<2> exchanged = state;
  std::swap(exchanged.positions[3], exchanged.positions[4]);
  CHECK(state_hash<2>(exchanged) != hash);
  State<2> zero{{{0.0, 1.0}}, {{0.0, 0.0}}}, negative{{{-0.0, 1.0}}, {{0.0, -0.0}}};
  CHECK(state_hash<2>(zero) == state_hash<2>(negative));
}

// A crystal expands in a wide box: its cells are small at first and larger later. A resumed run
// enlarges them earlier.
TEST_CASE("State hash: it is the same whenever cells are fitted to a cluster") {
  const Model<2> model = periodic_box(150.0, 140.0);
  State<2> start;
  for (int i = 0; i < 900; ++i) {
    Random random(1102, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    start.positions.push_back({40.0 + 1.05 * (i % 30), 50.0 + 1.05 * (i / 30)});
    start.velocities.push_back({random.normal(), random.normal()});
  }
  constexpr double kEnd = 1500.0;
  Simulation<2> whole(model, start);
  whole.run_until(kEnd);
  check_sound(whole);
  CHECK(whole.counts().pair_collisions > 60000);
  auto parts = std::make_unique<Simulation<2>>(model, start);
  for (double time = 50.0; time <= kEnd; time += 50.0) {
    parts->run_until(time);
    parts = std::make_unique<Simulation<2>>(model, parts->save());
  }
  check_sound(*parts);
  CHECK(parts->state_hash() == whole.state_hash());
  CHECK(parts->counts().cell_crossings < whole.counts().cell_crossings);
}

// Speeds of one disk after its hits of thermal walls. Before the first one it has had so many.
static std::vector<double> emitted_speeds(std::uint64_t before, std::uint64_t hits) {
  const Model<2> model = four(kThermal, kThermal);
  RunState<2> state = Simulation<2>(model, {{{4.0, 4.0}}, {{1.0, 0.3}}}).save();
  state.flights[0].number = static_cast<std::uint32_t>(before);
  state.counts.wall_collisions = before;
  state.era = static_cast<std::uint32_t>(before >> 31);
  Simulation<2> simulation(model, state);
  std::vector<double> speeds;
  for (std::uint64_t hit = 1; hit <= hits; ++hit) {
    simulation.run_until(kNever, before + hit);
    speeds.push_back(simulation.particles()[0].flight.v.norm());
  }
  return speeds;
}

TEST_CASE("Random numbers: they do not repeat with the 32 bits of a flight's number") {
  constexpr std::uint64_t kBefore = 100, kHits = 300;
  const std::vector<double> first = emitted_speeds(0, kHits);
  const std::vector<double> later = emitted_speeds((std::uint64_t{1} << 32) - kBefore, kHits);
  for (std::size_t hit = 0; hit + kBefore < kHits; ++hit) {
    CHECK(later[hit + kBefore] != first[hit]);
  }
  CHECK(emitted_speeds(0, kHits) == first);
}
