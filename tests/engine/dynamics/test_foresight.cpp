#include <doctest/doctest.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/dimension.h"
#include "engine/dynamics/certificate.h"
#include "engine/dynamics/foresight.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "engine/initial/start_state.h"
#include "engine/physics/random.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kForesightSeed = 5;

// Gases with every feature of the engine, in boxes that divide into several tiles.
const char* const kScenes[] = {
    R"(box.size = [70, 50]
       particles.area_fraction = 0.5)",
    R"(box.size = [70, 50]
       particles = { area_fraction = 0.3, restitution = 0.9, friction = 0.3 })",
    R"(box.size = [60, 70]
       particles = { area_fraction = 0.6, restitution = 0.95, tangential_restitution = 0.4 }
       walls.left = { kind = "thermal", temperature = 2.0 }
       walls.right = { kind = "driven", drive_speed = 1.0, friction = 0.2 })",
    R"(box.size = [70, 60]
       particles = { area_fraction = 0.2, restitution = 0.95 }
       gravity.acceleration = [0.1, -0.3]
       walls.bottom = { kind = "sinusoidal", stroke = 1.0, frequency = 0.7, friction = 0.3 }
       walls.top = { kind = "sawtooth", stroke = 0.5, frequency = 2.0, phase = 0.25 })",
    R"(box.size = [60, 60]
       particles = { area_fraction = 0.3, restitution = 0.9, friction = 0.4 }
       collapse.contact_time = 1e-3
       bulk_drive = { interval = 0.8, kick_speed = 0.2, kick_spin = 0.2 })",
    R"(box.size = [600, 6]
       particles = { area_fraction = 0.4, restitution = 0.9 }
       walls.bottom = { kind = "thermal", temperature = 1.0 }
       walls.top.kind = "static")",
    R"(box.size = [17000, 3]
       particles = { count = 2500, restitution = 0.95 })",
    R"(box.size = [90, 12, 10]
       particles = { volume_fraction = 0.3, restitution = 0.95 })",
    R"(box.size = [80, 13, 11]
       particles = { volume_fraction = 0.2, tangential_restitution = 0.5, friction = 0.2 }
       gravity.acceleration = [0.1, -0.2, 0.05]
       walls.bottom = { kind = "sinusoidal", stroke = 0.5, frequency = 2.0 }
       walls.top = { kind = "thermal", temperature = 2.0 })",
    R"(box.size = [70, 60]
       particles = { area_fraction = 0.3, restitution = 0.95 }
       walls.left.kind = "static"
       walls.right.kind = "static"
       obstacle = [{ kind = "ball", centre = [30, 1], radius = 7 },
                   { kind = "polygon", corners = [[45, 20], [60, 25], [50, 40]], friction = 0.3 }]
       partition = [{ axis = "y", position = 45, holes = [{ from = [20], to = [24] }] }])",
};

// A hash of all that observers see, in order.
template <int D>
class EventHash final : public Observer<D> {
 public:
  void on_collision(const PairCollision<D>& collision) override {
    add(collision.time);
    for (const ParticleChange<D>& change : collision.particles) add(change);
    add(collision.separation[0]);
    add(collision.undissipated);
  }
  void on_wall(const WallCollision<D>& collision) override {
    add(collision.time);
    add(static_cast<double>(collision.side));
    add(collision.particle);
  }
  void on_kick(const Kick<D>& kick) override { add(kick.particle); }
  void on_base_moved(double shift) override { add(shift); }
  std::uint64_t hash() const { return hash_; }

 private:
  void add(double number) {
    number += 0.0;  // the sign of a zero depends on which particle's plan is due first
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    hash_ = (hash_ ^ bits) * 0x9e3779b97f4a7c15u;
    hash_ ^= hash_ >> 29;
  }
  void add(const ParticleChange<D>& change) {
    add(static_cast<double>(change.particle));
    add(static_cast<double>(change.before.number));
    for (const double r : change.position) add(r);
    for (const double v : change.velocity) add(v);
    for (const double p : change.gain.momentum) add(p);
    add(change.energy());
  }

  std::uint64_t hash_ = 1;
};

// Everything that must not depend on tiles.
struct Outcome {
  std::vector<std::uint64_t> hashes;  // of the state at each halt
  std::uint64_t seen = 0;             // by an observer
  EventCounts counts;
  double overlap = 0.0;
  double mean_collision_time = 0.0;
  std::uint64_t until_base_moves = 0;
};

void check_equal(const Outcome& a, const Outcome& b) {
  CHECK(a.hashes == b.hashes);
  CHECK(a.seen == b.seen);
  CHECK(a.counts.pair_collisions == b.counts.pair_collisions);
  CHECK(a.counts.wall_collisions == b.counts.wall_collisions);
  CHECK(a.counts.kicks == b.counts.kicks);
  CHECK(a.counts.elasticised == b.counts.elasticised);
  CHECK(a.counts.elasticised_wall == b.counts.elasticised_wall);
  CHECK(a.overlap == b.overlap);
  CHECK(a.mean_collision_time == b.mean_collision_time);
  CHECK(a.until_base_moves == b.until_base_moves);
}

template <int D>
Outcome outcome_of(Simulation<D>& simulation, bool observed, int halts, std::uint64_t per_halt) {
  EventHash<D> events;
  if (observed) simulation.add_observer(events);
  Outcome outcome;
  for (int k = 1; k <= halts; ++k) {
    // Halts at times and at numbers of collisions.
    if (k % 2) {
      simulation.run_until(kNever, simulation.counts().collisions() + per_halt);
    } else {
      simulation.run_until(simulation.time() * 1.1);
    }
    outcome.hashes.push_back(simulation.state_hash());
  }
  CHECK(simulation.deepest_overlap() < 1e-11);
  outcome.seen = events.hash();
  outcome.counts = simulation.counts();
  outcome.overlap = simulation.checks().deepest_overlap;
  const RunState<D> saved = simulation.save();
  outcome.mean_collision_time = saved.mean_collision_time;
  outcome.until_base_moves = saved.until_base_moves;
  return outcome;
}

// Runs a scene as a whole, and in tiles of random sizes on different numbers of threads.
template <int D>
void compare_ways(const Model<D>& model, const State<D>& start, bool observed) {
  const auto count = static_cast<std::uint64_t>(start.positions.size());
  constexpr int kHalts = 6;
  Simulation<D> whole(model, start);
  const Outcome wanted = outcome_of(whole, observed, kHalts, 6 * count);
  Random random(kForesightSeed, Stream::Kick, 1, 1);
  std::uint64_t redone = 0;
  for (const int threads : {1, 2, 3}) {
    CAPTURE(threads);
    Simulation<D> tiled(model, start);
    const TileSizes sizes{.particles = 150.0 + 300.0 * random.uniform(),
                          .collisions = 0.5 + 2.0 * random.uniform(),
                          .halo = 1.0 + 6.0 * random.uniform()};
    CAPTURE(sizes.particles);
    CAPTURE(sizes.collisions);
    CAPTURE(sizes.halo);
    tiled.use_threads(threads, sizes);
    check_equal(outcome_of(tiled, observed, kHalts, 6 * count), wanted);
    const auto& work = tiled.foresight()->work();
    CHECK(tiled.foresight());
    CHECK(work.windows > 4);
    redone += work.redone;
  }
  CHECK(redone > 0);
}

template <int D>
void compare_ways(const Scene& scene, bool observed) {
  compare_ways(model_of<D>(scene, kForesightSeed), start_state<D>(scene, kForesightSeed), observed);
}

// A mixture in which every particle has a size of its own.
template <int D>
void compare_sizes(const Scene& scene, bool observed) {
  const Model<D> model = with_species(model_of<D>(scene, kForesightSeed));
  State<D> start = mixed(model, start_state<D>(scene, kForesightSeed), 1.4);
  const auto count = static_cast<double>(start.grains.size());
  double shrunk = 1.0;
  for (Grain& grain : start.grains) grain.radius *= shrunk -= 0.3 / count;
  GrainArray grains;
  grains.assign(start.grains);
  REQUIRE(grains.kinds().empty());
  compare_ways<D>(model, start, observed);
}

}  // namespace

TEST_CASE("Foresight: tiles give the bits of the whole gas for mixtures") {
  for (const double ratio : {1.4, 5.0}) {
    CAPTURE(ratio);
    for (const char* const text : {kScenes[2], kScenes[4]}) {
      CAPTURE(text);
      const Scene scene = parse_scene(text, "a scene");
      const Model<2> model = with_species(model_of<2>(scene, kForesightSeed));
      compare_ways<2>(model, mixed(model, start_state<2>(scene, kForesightSeed), ratio), true);
    }
    const Scene spheres = parse_scene(kScenes[7], "a scene");
    const Model<3> model = with_species(model_of<3>(spheres, kForesightSeed));
    compare_ways<3>(model, mixed(model, start_state<3>(spheres, kForesightSeed), ratio), false);
  }
}

// Up to 128 kinds of particles have numbers. Beyond, a tile copies the grain of each particle.
TEST_CASE("Foresight: tiles give the bits of the whole gas for particles of all sizes") {
  for (const bool observed : {false, true}) {
    CAPTURE(observed);
    compare_sizes<2>(parse_scene(kScenes[2], "a scene"), observed);
    compare_sizes<3>(parse_scene(kScenes[7], "a scene"), observed);
  }
}

TEST_CASE("Foresight: tiles give the bits of the whole gas, on any number of threads") {
  for (const char* const text : kScenes) {
    CAPTURE(text);
    const Scene scene = parse_scene(text, "a scene");
    for (const bool observed : {false, true}) {
      CAPTURE(observed);
      with_dimension(scene.dimension(),
                     [&](auto dimension) { compare_ways<dimension>(scene, observed); });
    }
  }
}

// The tiles exist before the partition does. It comes between two rows of the start.
TEST_CASE("Foresight: tiles see a partition that a change puts into the gas") {
  Scene scene = parse_scene(R"(box.size = [70, 60]
       particles = { area_fraction = 0.2, start.layout = "lattice" }
       partition = [{ axis = "y", position = 30, present = false }])",
                            "a scene");
  const Model<2> before = model_of<2>(scene, kForesightSeed);
  const State<2> start = start_state<2>(scene, kForesightSeed);
  std::set<double> rows;
  for (const Vec2& place : start.positions) rows.insert(place.y());
  const auto above = rows.upper_bound(30.0);
  REQUIRE(*above - *std::prev(above) > 1.0);
  scene.partitions[0].position = 0.5 * (*above + *std::prev(above));
  scene.partitions[0].present = true;
  const Model<2> after = model_of<2>(scene, kForesightSeed);
  Simulation<2> whole(before, start);
  whole.set_laws(after);
  const Outcome wanted = outcome_of(whole, false, 4, 3000);
  Simulation<2> tiled(before, start);
  tiled.use_threads(2, {.particles = 150.0, .collisions = 2.0, .halo = 5.0});
  tiled.set_laws(after);
  CHECK(wanted.counts.wall_collisions > 100);
  check_equal(outcome_of(tiled, false, 4, 3000), wanted);
}

TEST_CASE("Foresight: simultaneous collisions in several tiles have the order of the whole gas") {
  Model<2> model = periodic_box(60.0, 60.0);
  State<2> start;
  for (int i = 0; i < 900; ++i) {
    const Vec2 directions[] = {{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}};
    start.positions.push_back({1.0 + 2.0 * (i % 30), 1.25 + 2.0 * (i / 30)});
    start.velocities.push_back(directions[(i + i / 30) % 4]);
  }
  Random random(kForesightSeed, Stream::Kick, 2, 2);
  for (std::size_t i = start.positions.size() - 1; i > 0; --i) {
    const std::size_t j = random.below(i + 1);
    std::swap(start.positions[i], start.positions[j]);
    std::swap(start.velocities[i], start.velocities[j]);
  }
  for (const double restitution : {1.0, 0.9}) {
    model.restitution = restitution;
    Simulation<2> whole(model, start);
    const Outcome wanted = outcome_of(whole, true, 8, 2000);
    Simulation<2> tiled(model, start);
    tiled.use_threads(2, {.particles = 80.0, .collisions = 1.5, .halo = 4.0});
    check_equal(outcome_of(tiled, true, 8, 2000), wanted);
  }
}

TEST_CASE("Foresight: a saved run continues with the same bits on another number of threads") {
  const Scene scene = parse_scene(kScenes[2], "a scene");
  const Model<2> model = model_of<2>(scene, kForesightSeed);
  const State<2> start = start_state<2>(scene, kForesightSeed);
  Simulation<2> whole(model, start);
  const Outcome wanted = outcome_of(whole, false, 3, 9000);
  Simulation<2> first(model, start);
  first.use_threads(2, {.particles = 150.0, .collisions = 2.0, .halo = 5.0});
  outcome_of(first, false, 1, 9000);
  Simulation<2> second(model, first.save());
  second.use_threads(3, {.particles = 220.0, .collisions = 1.0, .halo = 4.0});
  second.run_until(second.time() * 1.1);
  CHECK(second.state_hash() == wanted.hashes[1]);
  Simulation<2> third(model, second.save());
  third.run_until(kNever, third.counts().collisions() + 9000);
  CHECK(third.state_hash() == wanted.hashes[2]);
}

TEST_CASE("Foresight: a collapsing gas stops at the same collision as without tiles") {
  const Scene scene = parse_scene(R"(box.size = [60, 60]
      particles = { area_fraction = 0.3, restitution = 0.3 })",
                                  "a scene");
  const Model<2> model = model_of<2>(scene, kForesightSeed);
  const State<2> start = start_state<2>(scene, kForesightSeed);
  const auto end = [&](bool tiles) {
    Simulation<2> simulation(model, start);
    if (tiles) simulation.use_threads(2, {.particles = 200.0, .collisions = 2.0, .halo = 8.0});
    CHECK_THROWS_AS(simulation.run_until(kNever), PhysicalStop);
    return simulation.counts().collisions() + simulation.state_hash();
  };
  CHECK(end(true) == end(false));
}

// The commands ask for a pause every tenth of a second, which is shorter than a window of a large
// gas.
TEST_CASE("Foresight: a window continues after a request to stop") {
  for (const bool observed : {false, true}) {
    const Scene scene = parse_scene(kScenes[0], "a scene");
    const Model<2> model = model_of<2>(scene, kForesightSeed);
    Simulation<2> whole(model, start_state<2>(scene, kForesightSeed));
    whole.run_until(3.0);
    Simulation<2> tiled(model, start_state<2>(scene, kForesightSeed));
    EventHash<2> observer;
    if (observed) tiled.add_observer(observer);
    tiled.use_threads(2, {.particles = 150.0, .collisions = 2.0, .halo = 5.0});
    bool complete = false;
    int pauses = 0;
    for (; !complete && pauses < 10'000; ++pauses) {
      std::atomic<int> questions = 0;
      complete = tiled.run_until(3.0, kNoLimit, kNoLimit, [&] { return ++questions > 2; });
      CHECK(tiled.tiles() == tiled.foresight()->tiles());
    }
    CHECK(complete);
    CHECK(tiled.state_hash() == whole.state_hash());
    const auto& work = tiled.foresight()->work();
    CHECK(work.windows >= 3);
    CHECK(static_cast<std::uint64_t>(pauses) > 2 * work.windows);
    // No tile has run in vain.
    CHECK(work.tiles == work.windows * tiled.tiles() + work.redone);
  }
}

TEST_CASE("Foresight: few threads run a gas in tiles only if it is not watched") {
  CHECK(watched_runs_in_tiles(4));
  CHECK(!watched_runs_in_tiles(3));
  Scene scene = parse_scene("box.size = [700, 600]\nparticles.count = 200_000", "a scene");
  const State<2> start = start_state<2>(scene, kForesightSeed);
  const auto tiles = [&](int threads, bool observed) {
    Simulation<2> simulation(model_of<2>(scene, kForesightSeed), start);
    simulation.use_threads(threads);
    EventHash<2> observer;
    if (observed) simulation.add_observer(observer);
    simulation.run_until(simulation.time());
    return simulation.tiles();
  };
  CHECK(tiles(2, false) > 1);
  CHECK(tiles(2, true) == 0);
  CHECK(tiles(4, true) > 1);
  scene.particles.restitution = 0.9;
  CHECK(tiles(2, false) == 0);
  CHECK(tiles(4, false) > 1);
}

TEST_CASE("Foresight: gases run in tiles where tiles pay") {
  CHECK(runs_in_tiles(2, 1'000'000, 2));
  CHECK(!runs_in_tiles(2, 1'000'000, 1));
  CHECK(runs_in_tiles(2, 10'000'000, 1));
  CHECK(runs_in_tiles(2, 100'000, 2));
  CHECK(!runs_in_tiles(2, 99'999, 16));
  CHECK(!runs_in_tiles(3, 1'000'000, 2));
  Simulation<2> small(periodic_box(20.0, 20.0), random_gas(periodic_box(20.0, 20.0), 100, 3));
  small.use_threads(8);
  CHECK(small.tiles() == 0);
  // A periodic box without room for halos has no tiles, whatever the number of threads.
  for (const int threads : {1, 2, 3}) {
    small.use_threads(threads, {.particles = 25.0, .collisions = 2.0, .halo = 10.0});
    CHECK(!small.foresight());
  }
}

// A kick cuts the window before it. That is no measure of the next one.
TEST_CASE("Foresight: after a cut window the next one is full") {
  Scene scene = parse_scene("box.size = [200, 190]\nparticles.count = 20_000", "a scene");
  scene.bulk_drive = BulkDrive{.interval = 0.5, .kick_speed = 0.001};
  Simulation<2> gas(model_of<2>(scene, kForesightSeed), start_state<2>(scene, kForesightSeed));
  gas.use_threads(2, {.particles = 2500.0, .collisions = 2.0, .halo = 9.0});
  gas.run_until(2.0);
  const std::uint64_t windows = gas.foresight()->work().windows;
  const std::uint64_t collisions = gas.counts().collisions();
  gas.run_until(10.0);
  CHECK(gas.tiles() > 1);
  const double full = static_cast<double>(gas.counts().collisions() - collisions) / 20'000.0;
  const double found = static_cast<double>(gas.foresight()->work().windows - windows);
  CHECK(found < full + 16.0);  // one more for each kick
}

TEST_CASE("Certificate: each term counts") {
  // Halos 10 wide, contact at 1, no particle went farther than 4.
  const Certificate good(10.0, 1.0, 4.0);
  CHECK(good.lack(-2.0, 0.0) == doctest::Approx(-7.0));
  CHECK(good.lack(4.5, 0.0) == doctest::Approx(-0.5));
  CHECK(good.lack(5.5, 0.0) == doctest::Approx(0.5));
  CHECK(good.lack(4.5, 0.5) == doctest::Approx(0.5));
  CHECK(Certificate(10.0, 2.0, 4.0).lack(4.5, 0.0) == doctest::Approx(0.5));
  CHECK(Certificate(10.0, 1.0, 5.0).lack(4.5, 0.0) == doctest::Approx(0.5));
  CHECK(Certificate(9.0, 1.0, 4.0).lack(4.5, 0.0) == doctest::Approx(0.5));
  Certificate wrong_in_tile = good, wrong_in_truth = good, far = good;
  wrong_in_tile.add_wrong_copy(3.0, 0.0, 2.0);
  wrong_in_truth.add_wrong_copy(0.0, 3.0, 2.0);
  far.add_wrong_copy(3.0, 3.0, 9.5);
  CHECK(wrong_in_tile.lack(-2.5, 0.0) == doctest::Approx(-0.5));
  CHECK(wrong_in_tile.lack(-1.5, 0.0) == doctest::Approx(0.5));
  CHECK(wrong_in_truth.lack(-1.5, 0.0) == doctest::Approx(0.5));
  CHECK(far.lack(-2.0, 0.0) == doctest::Approx(-7.0));
}

namespace {

// Particles at rest on a lattice in the lower part of a long box, and a row of particles above it:
// their x, and the velocity of the last.
State<2> row_of(const std::vector<double>& places, double velocity) {
  State<2> state;
  for (int i = 0; i < 4000; ++i) {
    state.positions.push_back({1.0 + 2.0 * (i % 200), 1.5 + 2.0 * (i / 200)});
    state.velocities.push_back(Vec2::Zero());
  }
  for (const double x : places) {
    state.positions.push_back({x, 60.0});
    state.velocities.push_back(Vec2::Zero());
  }
  state.velocities.back()[0] = velocity;
  return state;
}

// The first window of a gas in a box of 400 x 80, in tiles that meet at x = 96, among others. In
// this window a particle flies 0.1 diameters at the gas's mean speed: 8.9 diameters if one particle
// has all the energy.
struct FirstWindow {
  std::uint64_t events = 0;
  std::uint64_t redone = 0;
};
FirstWindow first_window(const State<2>& state, double halo) {
  const Model<2> model = periodic_box(400.0, 80.0);
  const Boundary<2> boundary(model, Clock());
  Foresight<2> foresight(model, boundary, kAlike, state.positions.size(), 2,
                         {.particles = 1000.0, .collisions = 1.0, .halo = halo});
  REQUIRE(foresight.tiles() == 4);
  const EventLoop<2> loop(model, boundary, Simulation<2>(model, state).save());
  REQUIRE(foresight.look_ahead(loop.gas(), kNever, 1'000'000) == Foresight<2>::Outcome::Done);
  return {foresight.work().own, foresight.work().redone};
}

}  // namespace

TEST_CASE("Foresight: a particle from beyond the halo that reaches the core is found") {
  const FirstWindow window = first_window(row_of({95.5, 103.0}, -40.0), 6.0);
  CHECK(window.events == 1);
  CHECK(window.redone > 0);
}

TEST_CASE("Foresight: a copy that a particle from beyond the halo pushes into the core is found") {
  const FirstWindow window = first_window(row_of({95.5, 100.0, 106.3}, -40.0), 9.0);
  CHECK(window.events == 2);
  CHECK(window.redone > 0);
}

// Fast particles reach cores from beyond narrow halos, so most tiles run again.
TEST_CASE("Foresight: sparse gases with a few fast particles have the bits of the whole") {
  constexpr int kGases = 500;
  constexpr double kTiles = 16.0;
  std::uint64_t windows = 0, redone = 0;
  for (std::uint64_t seed = 1; seed <= kGases; ++seed) {
    CAPTURE(seed);
    Scene scene = default_scene(2);
    scene.box.setConstant(64.0);
    scene.particles.count = 60;
    const Model<2> model = model_of<2>(scene, seed);
    State<2> start = start_state<2>(scene, seed);
    Random random(seed, Stream::Kick, 1, 1);
    for (Vec2& v : start.velocities) v *= random.uniform() < 0.1 ? 8.0 : 0.2;
    Simulation<2> whole(model, start), tiled(model, start);
    tiled.use_threads(1, {.particles = scene.particles.count / kTiles,
                          .collisions = 2.0,
                          .halo = 2.0 + 6.0 * random.uniform()});
    REQUIRE(tiled.foresight());
    for (const double time : {20.0, 40.0, 60.0}) {
      whole.run_until(time);
      tiled.run_until(time);
      CHECK(tiled.state_hash() == whole.state_hash());
    }
    windows += tiled.foresight()->work().windows;
    redone += tiled.foresight()->work().redone;
  }
  CHECK(windows > 2 * kGases);
  CHECK(redone > 10 * kGases);
}

TEST_CASE("Foresight: a run whose limit of collisions is reached does not continue") {
  const Model<2> model = periodic_box(70.0, 50.0);
  Simulation<2> whole(model, random_gas(model, 1500, 3));
  CHECK(!whole.run_until(kNever, 9000));
  Simulation<2> tiled(model, whole.save());
  tiled.use_threads(2, {.particles = 200.0, .collisions = 1.0, .halo = 4.0});
  CHECK(!tiled.run_until(kNever, 5000));
  CHECK(tiled.counts().collisions() == 9000);
  CHECK(tiled.state_hash() == whole.state_hash());
}

namespace {

// Cold gases that walls, gravity or a fast particle drive.
const char* const kColdScenes[] = {
    R"(walls.left = { kind = "thermal", temperature = 4.0 }
       walls.right.kind = "static")",
    R"(walls.left = { kind = "driven", drive_speed = 2.0 }
       walls.right = { kind = "sinusoidal", stroke = 0.3, frequency = 2.0 })",
    R"(walls.bottom.kind = "static"
       walls.top.kind = "static"
       gravity.acceleration = [0.0, -1.0])",
    R"(change = [{ time = 0.1, nudge = { particle = 5, set = [3.0, 0.0] } }])",
};

}  // namespace

// The present rate of collisions says nothing about the next window.
TEST_CASE("Foresight: a cold gas that is driven has the bits of the whole") {
  for (const char* const text : kColdScenes) {
    CAPTURE(text);
    for (const char* const temperature : {"0.0", "1e-10", "1e-6"}) {
      CAPTURE(temperature);
      const Scene scene = parse_scene(
          {std::string("box.size = [70, 60]\nparticles.count = 2200\n") + text, "a scene"},
          {{"particles.start.temperature", temperature}});
      const auto run = [&](bool tiles) {
        auto gas = std::make_unique<ScheduledRun<2>>(scene, kForesightSeed);
        if (tiles)
          gas->simulation().use_threads(2, {.particles = 300.0, .collisions = 2.5, .halo = 8.0});
        gas->run_until(30.0);
        return gas;
      };
      const auto whole = run(false), tiled = run(true);
      CHECK(whole->simulation().state_hash() == tiled->simulation().state_hash());
    }
  }
}

// Disks of a lattice touch the walls, and half of them move towards them.
TEST_CASE("Foresight: events at the time of the start are processed up to this time") {
  const Scene scene = parse_scene(R"(box.size = [60, 60]
      particles = { count = 1600, start.layout = "lattice" }
      walls.left = { kind = "static", restitution = 0.5 }
      walls.right = { kind = "static", restitution = 0.5 })",
                                  "a scene");
  const Model<2> model = model_of<2>(scene, kForesightSeed);
  const State<2> start = start_state<2>(scene, kForesightSeed);
  Simulation<2> whole(model, start), tiled(model, start);
  tiled.use_threads(2, {.particles = 200.0, .collisions = 2.0, .halo = 8.0});
  REQUIRE(tiled.foresight());
  CHECK(whole.run_until(0.0));
  CHECK(tiled.run_until(0.0));
  CHECK(whole.counts().wall_collisions > 10);
  CHECK(tiled.counts().wall_collisions == whole.counts().wall_collisions);
}

// The time to leave the tiles is compared with that of a start.
TEST_CASE("Foresight: a gas that leaves its tiles is planned again in little time") {
  const auto seconds = [](const auto& act) {
    const std::clock_t begin = std::clock();
    act();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  const Model<2> model = periodic_box(400.0, 400.0);
  State<2> state = random_gas(model, 60'000, 3);
  for (Vec2& velocity : state.velocities) velocity.setZero();  // no window
  std::optional<Simulation<2>> gas;
  const double start = seconds([&] { gas.emplace(model, state); });
  gas->use_threads(2, {.particles = 10'000.0, .collisions = 2.5, .halo = 8.0});
  CHECK(gas->foresight());
  const double leaving = seconds([&] { CHECK(gas->run_until(1.0)); });
  CHECK(leaving < 20.0 * start + 0.1);
}
