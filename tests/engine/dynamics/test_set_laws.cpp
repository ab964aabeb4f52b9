// Laws that change in place, observers that end, and particles that enter.

#include <doctest/doctest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/models.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kChangedAt = 3.3;

// A gas between walls that move in each way, and its bulk driving.
template <int D>
Model<D> law_model() {
  Vec<D> box = Vec<D>::Constant(9.0);
  box[0] = 12.0;
  Model<D> model = periodic_box<D>(box);
  model.walls[kLeft] = kSawtooth;
  model.walls[kRight] = kThermal;
  model.walls[kBottom] = kDriven;
  model.walls[kTop] = kSinusoidal;
  model.restitution = 0.9;
  model.contact_time = 2e-3;
  model.bulk_drive = BulkDrive{.interval = 0.5, .kick_speed = 0.1};
  return model;
}

template <int D>
struct NamedChange {
  std::string name;
  std::function<void(Model<D>&)> make;
};

template <int D>
std::vector<NamedChange<D>> law_changes() {
  return {
      {"nothing", [](Model<D>&) {}},
      {"restitution", [](Model<D>& m) { m.restitution = 0.5; }},
      {"friction",
       [](Model<D>& m) {
         m.roughness = {.friction = 0.3, .tangential_restitution = 0.5};
         m.spins = true;
       }},
      {"inertia", [](Model<D>& m) { m.inertia = 0.2; }},
      {"contact time", [](Model<D>& m) { m.contact_time.reset(); }},
      {"wall temperature", [](Model<D>& m) { m.walls[kRight]->temperature = 9.0; }},
      {"drive speed", [](Model<D>& m) { m.walls[kBottom]->drive_speed = 3.0; }},
      {"kick speed", [](Model<D>& m) { m.bulk_drive->kick_speed = 1.0; }},
      {"kick interval", [](Model<D>& m) { m.bulk_drive->interval = 0.35; }},
      {"no kicks", [](Model<D>& m) { m.bulk_drive.reset(); }},
      {"gravity", [](Model<D>& m) { m.gravity[1] = -0.5; }},
      {"frequency", [](Model<D>& m) { m.walls[kLeft]->frequency = 3.0; }},
      {"stroke", [](Model<D>& m) { m.walls[kTop]->stroke = 0.1; }},
  };
}

// Checks that a change in place has the bits of a new simulation that continues the saved run.
template <int D>
void check_as_continued(int count) {
  const Model<D> model = law_model<D>();
  for (const NamedChange<D>& change : law_changes<D>()) {
    CAPTURE(change.name);
    Simulation<D> changed(model, clear_gas<D>(model, count, 3));
    changed.run_until(kChangedAt);
    Model<D> next = model;
    change.make(next);
    RunState<D> saved = changed.save();
    saved.watchdog.reset();
    std::optional<Simulation<D>> run;
    try {
      run.emplace(next, saved);
    } catch (const PhysicalStop& stop) {
      CHECK_THROWS_WITH_AS(changed.set_laws(next), stop.what(), PhysicalStop);
      continue;
    }
    Simulation<D>& continued = *run;
    changed.set_laws(next);
    CHECK(changed.state_hash() == continued.state_hash());
    for (const double time : {kChangedAt, 5.0, 8.0}) {
      CAPTURE(time);
      changed.run_until(time);
      continued.run_until(time);
      CHECK(changed.state_hash() == continued.state_hash());
      CHECK(changed.counts().collisions() == continued.counts().collisions());
      CHECK(changed.deepest_overlap() < 1e-9);
    }
  }
}

// Notes the calls that concern laws, and the number of collisions.
class LawWitness final : public Observer<2> {
 public:
  explicit LawWitness(const Simulation<2>& simulation) : simulation_(simulation) {}

  void on_collision(const PairCollision<2>&) override { ++collisions; }
  void before_laws(const Model<2>& next) override {
    before.push_back(simulation_.model().restitution);
    announced.push_back(next.restitution);
    flights.push_back(simulation_.particles()[0].flight.time);
  }
  void on_laws() override {
    after.push_back(simulation_.model().restitution);
    particles.push_back(simulation_.particles().size());
    flights.push_back(simulation_.particles()[0].flight.time);
  }

  std::vector<double> before, announced, after, flights;
  std::vector<std::size_t> particles;
  int collisions = 0;

 private:
  const Simulation<2>& simulation_;
};

}  // namespace

TEST_CASE("Laws: a change in place has the bits of a run that continues under the new laws") {
  check_as_continued<2>(24);
  check_as_continued<3>(60);
}

TEST_CASE("Laws: a change in place has the same bits with tiles, also for an observed gas") {
  Model<2> elastic = periodic_box(70.0, 50.0);  // nothing needs its events in order
  elastic.contact_time = 1e-4;
  Model<2> driven = with_walls(elastic, 0, kThermal);
  driven.restitution = 0.9;
  const TileSizes sizes{.particles = 300.0, .collisions = 1.0, .halo = 8.0};
  int in_tiles = 0;
  for (const Model<2>& model : {elastic, driven}) {
    const State<2> start = clear_gas<2>(model, 1200, 3);
    for (const double first : {0.0, 0.7}) {
      const bool observed = first > 0.0 && model.restitution < 1.0;
      CAPTURE(observed);
      CAPTURE(first);
      Simulation<2> whole(model, start), tiled(model, start);
      LawWitness witness(tiled);
      std::optional<Observation<2>> observation;
      if (observed) observation.emplace(tiled, witness);
      tiled.use_threads(2, sizes);
      Model<2> next = model;
      for (int part = 0; part < 6; ++part) {
        CAPTURE(part);
        const double time = first + 3.0 * part;  // longer than a window of tiles
        whole.run_until(time);
        tiled.run_until(time);
        in_tiles += tiled.tiles() > 1;
        CHECK(whole.state_hash() == tiled.state_hash());
        next.restitution = model.restitution < 1.0 ? 0.9 - 0.05 * part : 1.0;
        next.gravity[1] = part % 2 ? 0.0 : -0.2;
        next.contact_time.reset();
        if (part % 3 == 2) next.contact_time = 1e-4;
        if (part == 3) next.roughness = {.friction = kInfinity, .tangential_restitution = 1.0};
        next.spins = next.roughness.any();
        whole.set_laws(next);
        tiled.set_laws(next);
      }
    }
  }
  CHECK(in_tiles > 8);
}

TEST_CASE("Laws: a refused change does not change the run") {
  Model<2> model = four(kStatic, kSawtooth);
  Simulation<2> plain(model, clear_gas<2>(model, 20, 4)), refusing(model, plain.state());
  LawWitness witness(refusing);
  const Observation<2> observation(refusing, witness);
  for (int part = 0; part < 10; ++part) {
    // At these times the phase of the walls is 0.75.
    refusing.run_until(0.25 + 0.5 * part);
    Model<2> next = refusing.model();
    next.walls[kBottom]->stroke = 7.0;  // the box is 8 high
    next.restitution = 0.1;
    CHECK_THROWS_WITH_AS(refusing.set_laws(next), doctest::Contains("walls.bottom"), PhysicalStop);
  }
  CHECK(witness.before.empty());
  plain.run_until(5.0);
  refusing.run_until(5.0);
  CHECK(refusing.state_hash() == plain.state_hash());
}

TEST_CASE("Laws: observers hear of a change before and after it, and of none after their end") {
  const Model<2> model = four(kStatic, kStatic);
  Simulation<2> simulation(model, clear_gas<2>(model, 20, 4));
  LawWitness witness(simulation);
  std::optional<Observation<2>> observation(std::in_place, simulation, witness);
  simulation.run_until(2.0);
  CHECK(witness.collisions > 0);
  Model<2> next = model;
  next.restitution = 0.8;
  simulation.set_laws(next);
  CHECK(witness.before == std::vector<double>{1.0});
  CHECK(witness.announced == std::vector<double>{0.8});
  CHECK(witness.after == std::vector<double>{0.8});
  CHECK(witness.flights[0] == witness.flights[1]);
  next.gravity = {0.0, -1.0};
  simulation.set_laws(next);
  CHECK(witness.flights[2] < simulation.base_time());
  CHECK(witness.flights[3] == simulation.base_time());
  observation.reset();
  const int collisions = witness.collisions;
  simulation.set_laws(model);
  simulation.run_until(4.0);
  CHECK(witness.before.size() == 2);
  CHECK(witness.collisions == collisions);
}

TEST_CASE("Laws: particles that enter are at rest, with the highest numbers") {
  const Model<2> model = four(kStatic, kStatic);
  State<2> start;
  start.positions = {{2.0, 2.0}, {7.0, 6.0}};
  start.velocities = {{0.1, 0.0}, {0.0, -0.1}};
  Simulation<2> simulation(model, start);
  LawWitness witness(simulation);
  const Observation<2> observation(simulation, witness);
  simulation.run_until(1.0);
  simulation.add_particles({{4.5, 4.0}});
  CHECK(witness.particles == std::vector<std::size_t>{3});
  CHECK(simulation.time() == 1.0);
  const State<2> state = simulation.state();
  CHECK(state.positions[0][0] == doctest::Approx(2.1));
  CHECK(state.positions[2] == Vec<2>(4.5, 4.0));
  CHECK(state.velocities[2] == Vec<2>(0.0, 0.0));
  CHECK(simulation.run_until(2.0));
}

TEST_CASE("Timers: they end with their owner, and others go on") {
  const Model<2> model = four(kStatic, kStatic);
  Simulation<2> simulation(model, clear_gas<2>(model, 5, 4));
  int owned = 0, free = 0;
  simulation.every(1.0, 1.0, [&](double) { ++free; });
  {
    Timers<2> timers(simulation);
    timers.every(1.0, 1.0, [&](double) { ++owned; });
    timers.every(0.5, 0.5, [&](double) { ++owned; });
    simulation.run_until(2.0);
  }
  CHECK(owned == 6);
  simulation.run_until(4.0);
  CHECK(owned == 6);
  CHECK(free == 4);
}
