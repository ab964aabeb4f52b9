#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/dynamics/near_particles.h"
#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/measure/totals.h"
#include "engine/physics/contact.h"
#include "engine/physics/random.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/support/dimensions.h"

// Sheared boxes after Lees and Edwards (theory 14).

namespace clatter::sheared_boxes {

using namespace clatter::testing;

// Deepest overlap of two particles through any image, as a share of the diameter.
template <int D>
double deepest_overlap(const Simulation<D>& simulation) {
  const State<D> state = simulation.state();
  const Domain<D> domain = simulation.domain();
  const auto count = static_cast<std::uint32_t>(state.positions.size());
  double deepest = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const double distance = simulation.grain(i).radius + simulation.grain(j).radius;
      for (const double up : {-1.0, 0.0, 1.0}) {
        Vec<D> way = state.positions[i] - state.positions[j];
        for (int axis = 0; axis < D; ++axis) {
          if (axis == 1 || !domain.periodic[axis]) continue;
          if (axis == 0) way[0] += up * domain.offset;
          way[axis] -= domain.box[axis] * std::round(way[axis] / domain.box[axis]);
        }
        way[1] += up * domain.box[1];
        deepest = std::max(deepest, distance - way.norm());
      }
    }
  }
  return deepest / simulation.model().diameter;
}

// The state after so many collisions must equal the reference to the last bit.
template <int D>
void compare(const std::string& name, const Model<D>& model, const State<D>& start,
             std::uint64_t collisions = 2000) {
  CAPTURE(name);
  CAPTURE(start.positions.size());
  Simulation<D> simulation(model, start);
  run_beside_reference(simulation, start, collisions);
  CHECK(deepest_overlap(simulation) < 1e-12);
  CHECK(simulation.deepest_overlap() < 1e-12);
  // Two particles fly through hundreds of images between collisions, far from the origin.
  CHECK(simulation.checks().deepest_overlap < (start.positions.size() == 2 ? 1e-11 : 1e-12));
  CHECK(simulation.checks().clock_steps_back < 1e-12);
}

// Brute force looks at many images of a gas that is sheared fast.
template <int D>
void compare(const std::string& name, const Model<D>& model, const std::vector<int>& counts) {
  const double slide = std::fabs(*model.shear_rate) * model.box[1];
  const std::uint64_t collisions = slide > 20.0 ? 500 : 2000;
  for (const int count : counts) {
    compare<D>(name, model, gas_in_flow<D>(model, count), collisions);
  }
}

TEST_CASE("Sheared boxes: disks agree with brute force to the bit") {
  compare<2>("wide", sheared(inelastic(periodic_box(9.0, 8.0), 0.9), 0.5), {2, 3, 7, 16, 30});
  compare<2>("backwards and fast", sheared(inelastic(periodic_box(9.0, 8.0), 0.9), -7.0),
             {2, 12, 30});
  compare<2>("slow", sheared(periodic_box(9.0, 8.0), 1e-3), {2, 12, 30});
  compare<2>("dense", sheared(inelastic(periodic_box(6.2, 6.1), 0.9), 1.0), {30});
  compare<2>("narrow along the flow", sheared(inelastic(periodic_box(1.9, 9.0), 0.9), 1.0),
             {2, 5, 8});
  compare<2>("two cells along the flow", sheared(inelastic(periodic_box(2.5, 9.0), 0.9), 1.0),
             {2, 5, 12});
  compare<2>("one row of cells", sheared(inelastic(periodic_box(12.0, 2.01), 0.9), 1.0),
             {2, 5, 12});
  compare<2>("two rows of cells", sheared(inelastic(periodic_box(12.0, 2.5), 0.9), 3.0),
             {2, 5, 14});
  compare<2>("three rows of cells", sheared(inelastic(periodic_box(5.0, 3.4), 0.8), 3.0),
             {2, 5, 9});
  Model<2> kicked = sheared(inelastic(periodic_box(9.0, 8.0), 0.8), 0.5);
  kicked.bulk_drive = {.interval = 0.1, .kick_speed = 0.2};
  compare<2>("kicks", kicked, {2, 12, 30});
  Model<2> rough = sheared(inelastic(periodic_box(9.0, 8.0), 0.8), 0.5);
  rough.roughness = {.friction = 0.3, .tangential_restitution = 0.5};
  rough.spins = true;
  compare<2>("rough", rough, {2, 12, 30});
  Model<2> timed = sheared(inelastic(periodic_box(9.0, 8.0), 0.2), 0.5);
  timed.contact_time = 0.01;
  compare<2>("t_c", timed, {3, 12, 30});
}

TEST_CASE("Sheared boxes: spheres agree with brute force to the bit") {
  compare<3>("wide", sheared(inelastic(periodic_box(6.0, 5.0, 7.0), 0.9), 0.5), {2, 3, 16, 30});
  compare<3>("backwards and fast", sheared(inelastic(periodic_box(6.0, 5.0, 7.0), 0.9), -7.0),
             {2, 12});
  compare<3>("dense", sheared(inelastic(periodic_box(3.3, 3.4, 3.5), 0.9), 1.0), {27});
  compare<3>("one row of cells", sheared(inelastic(periodic_box(5.0, 2.01, 4.0), 0.9), 1.0),
             {2, 14});
  compare<3>("narrow", sheared(inelastic(periodic_box(2.2, 6.0, 2.3), 0.9), 1.0), {2, 12});
  compare<3>("between walls",
             sheared(inelastic(with_walls(periodic_box(6.0, 5.0, 7.0), 2, kLossy), 0.9), 0.5),
             {2, 30});
}

TEST_CASE_TEMPLATE("Sheared boxes: mixtures agree with brute force to the bit", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Model<D> model =
      sheared(inelastic(periodic_box<D>(Vec<D>::Constant(D == 2 ? 12.0 : 7.0)), 0.9), 0.7);
  for (const double ratio : {1.4, 5.0}) {
    compare<D>("mixture", model, in_flow<D>(model, mixed_gas(model, 24, 81, ratio)), 1000);
  }
}

// Disk 0 at (2, 7.8) rises at 1, and disk 1 at (5, 0.4) falls at 1. The box is 10 x 8, G = 0.5: the
// image of disk 1 above is at y = 8.4, moves along x at 4 and starts at x = 5 with velocity 4. Both
// have the x velocity 0 in the box. Relative to disk 0 the image is at (3 + 4 t, 0.6 - 2 t): it
// comes no nearer. With G = -0.5 it is at (3 - 4 t, 0.6 - 2 t). |x|^2 = 20 t^2 - 26.4 t + 9.36 is 1
// at t = (26.4 - sqrt(26.4^2 - 4 20 8.36))/40 = 0.5273. There n = (-0.891, 0.455) from 1 to 0.
TEST_CASE("Sheared boxes: a contact across the border by hand") {
  State<2> start;
  start.positions = {{2.0, 7.8}, {5.0, 0.4}};
  start.velocities = {{0.0, 1.0}, {0.0, -1.0}};
  Simulation<2> apart(sheared(periodic_box(10.0, 8.0), 0.5), start);
  apart.run_until(0.7);
  CHECK(apart.counts().pair_collisions == 0);
  Simulation<2> meet(sheared(periodic_box(10.0, 8.0), -0.5), start);
  const double time = (26.4 - std::sqrt(26.4 * 26.4 - 80.0 * 8.36)) / 40.0;
  meet.run_until(time - 1e-9);
  CHECK(meet.counts().pair_collisions == 0);
  meet.run_until(time + 1e-9);
  CHECK(meet.counts().pair_collisions == 1);
  // Equal elastic masses exchange their velocities along n, in the frame of disk 0.
  const Vec2 n(-(3.0 - 4.0 * time), -(0.6 - 2.0 * time));
  const Vec2 g(4.0, 2.0);  // v_0 - v_1 there
  const Vec2 change = -g.dot(n) * n;
  // Both have crossed the border: disk 0 is at the bottom now, where the flow is faster by 4.
  const Vec2 flow(4.0, 0.0);
  const State<2> after = meet.state();
  CHECK(after.positions[0].y() == doctest::Approx(7.8 + time - 8.0).epsilon(1e-7));
  CHECK((after.velocities[0] - start.velocities[0] - change - flow).norm() < 1e-8);
  CHECK((after.velocities[1] - start.velocities[1] + change + flow).norm() < 1e-8);
}

TEST_CASE("Sheared boxes: rate 0, one disk and none") {
  compare<2>("rate 0", sheared(inelastic(periodic_box(9.0, 8.0), 0.9), 0.0), {2, 12, 30});
  for (const int count : {0, 1}) {
    const Model<2> model = sheared(periodic_box(9.0, 8.0), 2.0);
    Simulation<2> simulation(model, gas_in_flow<2>(model, count));
    CHECK(simulation.run_until(50.0));
  }
}

TEST_CASE("Sheared boxes: halts and timers change no bit, nor does a copy of the run") {
  const Model<2> model = sheared(inelastic(periodic_box(9.0, 8.0), 0.9), 0.7);
  const State<2> start = gas_in_flow<2>(model, 30);
  Simulation<2> whole(model, start), halted(model, start);
  int calls = 0;
  halted.every(0.3, 0.3, [&](double) { ++calls; });
  whole.run_until(200.0);
  for (const double time : {0.1, 7.7, 60.3, 131.0}) halted.run_until(time);
  Simulation<2> continued(model, halted.save());
  halted.run_until(200.0);
  continued.run_until(200.0);
  CHECK(calls == 666);
  CHECK(halted.state_hash() == whole.state_hash());
  CHECK(continued.state_hash() == whole.state_hash());
}

// A flight seen from the image of its partner is a flight in a box that is not sheared.
TEST_CASE("Sheared boxes: the contact through an image is that with a body that moves along") {
  double farthest = 0.0;
  int contacts = 0, missed = 0;
  for (std::uint32_t number = 0; number < 20000; ++number) {
    Random random(5, Stream::Velocity, number, 0);
    const auto vector = [&] { return Vec2(4.0 * random.normal(), 4.0 * random.normal()); };
    const Flight<2> a{vector(), vector(), random.uniform(), 1}, b{vector(), vector(), 0.5, 1};
    const Vec2 shift = vector();
    const double slide = 3.0 * random.normal();
    const double time = contact_time<2>(a, b, shift, 1.0, Vec2::Zero(), slide);
    CHECK(time == contact_time<2>(b, a, -shift, 1.0, Vec2::Zero(), -slide));
    const Flight<2> moved{a.r + shift + slide * a.time * Vec2::Unit(0), a.v + slide * Vec2::Unit(0),
                          a.time, 1};
    const double same = contact_time<2>(moved, b, Vec2::Zero(), 1.0, Vec2::Zero());
    if (time == kNever || same == kNever) {
      missed += time != same;
      continue;
    }
    ++contacts;
    farthest = std::max(farthest, std::fabs(time - same) / (1.0 + std::fabs(time)));
  }
  CHECK(contacts > 900);
  CHECK(farthest < 1e-8);  // grazing contacts are ill-conditioned
  CHECK(missed == 0);
}

TEST_CASE("Sheared boxes: the image of a place is consistent with its shift") {
  Domain<3> domain = sheared(periodic_box(5.0, 4.0, 3.0), 2.0).domain();
  domain.offset = 1.7;
  for (std::uint32_t number = 0; number < 1000; ++number) {
    Random random(5, Stream::Velocity, number, 0);
    const Vec<3> place(30.0 * random.normal(), 30.0 * random.normal(), 9.0 * random.normal());
    const Vec<3> image = domain.image_at(place), home = domain.wrapped(place);
    CHECK((home.array() >= -1e-13).all());
    CHECK((home.array() <= domain.box.array() * (1.0 + 1e-13)).all());
    CHECK(image[1] == std::floor(place[1] / 4.0));
    CHECK(std::fabs(home[0] + 5.0 * image[0] + 1.7 * image[1] - place[0]) < 1e-12);
    // The shortest of the ways to all images around.
    double shortest = 1e9;
    for (const double up : {-1.0, 0.0, 1.0}) {
      for (const double right : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
        for (const double front : {-1.0, 0.0, 1.0}) {
          shortest = std::min(shortest, (home + domain.shift(Vec<3>(right, up, front))).norm());
        }
      }
    }
    CHECK(domain.shortest(place).norm() == doctest::Approx(shortest).epsilon(1e-12));
  }
  const Domain<3> later = domain.at(0.5);
  CHECK(later.offset == 1.7 + 0.5 * 8.0);
  CHECK(domain.shift(Vec<3>(1.0, 2.0, -1.0), 0.5).isApprox(Vec<3>(5.0 + 2.0 * 5.7, 8.0, -3.0)));
  // The velocity without the flow is the same in all images.
  CHECK(domain.peculiar(Vec<3>(0.0, 3.0, 0.0), Vec<3>(1.0, 2.0, 3.0))
            .isApprox(domain.peculiar(Vec<3>(0.0, 7.0, 0.0), Vec<3>(9.0, 2.0, 3.0))));
}

TEST_CASE("Sheared boxes: a changed rate keeps places and velocities beside the flow") {
  const Model<2> slow = sheared(inelastic(periodic_box(9.0, 8.0), 0.9), 0.7);
  const Model<2> fast = sheared(slow, -2.1);
  Simulation<2> simulation(slow, gas_in_flow<2>(slow, 30));
  simulation.run_until(123.4);
  const State<2> before = simulation.state();
  const double temperature = simulation.temperature(), offset = simulation.domain().offset;
  simulation.set_laws(fast);
  const State<2> after = simulation.state();
  CHECK(simulation.temperature() == doctest::Approx(temperature).epsilon(1e-12));
  const double lengths = (simulation.domain().offset - offset) / 9.0;
  CHECK(std::fabs(lengths - std::round(lengths)) < 1e-12);
  for (std::size_t i = 0; i < before.positions.size(); ++i) {
    CHECK((before.positions[i] - after.positions[i]).norm() < 1e-12);
    const double change = -2.8 * (before.positions[i].y() - 4.0);
    CHECK((after.velocities[i] - before.velocities[i] - change * Vec2::Unit(0)).norm() < 1e-12);
  }
  simulation.run_until(200.0);
  CHECK(deepest_overlap(simulation) < 1e-12);
  check_sound(simulation);
}

TEST_CASE("Sheared boxes: a scene starts with the flow, and keeps its rate when it is written") {
  const Scene scene = parse_scene(
      "box.size = [30, 20]\nparticles.count = 150\nparticles.start.temperature = 2\n"
      "shear.rate = -1.5\n",
      "s.toml");
  CHECK(scene_to_toml(parse_scene(scene_to_toml(scene), "t.toml")) == scene_to_toml(scene));
  const Simulation<2> simulation(model_of<2>(scene, 1), start_state<2>(scene, 1));
  CHECK(simulation.model().shear_rate == -1.5);
  CHECK(simulation.temperature() == doctest::Approx(2.0).epsilon(1e-12));
  // The correlation of velocity and height is that of the flow, -1.5 <(y - 10)^2>.
  double correlation = 0.0, spread = 0.0;
  const State<2> state = simulation.state();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const double height = state.positions[i].y() - 10.0;
    correlation += state.velocities[i].x() * height;
    spread += height * height;
  }
  CHECK(correlation / spread == doctest::Approx(-1.5).epsilon(0.05));
}

// All images of 60 points within a distance, against those that a search finds.
TEST_CASE("Sheared boxes: the view of another gas loses its balances") {
  const Scene scene =
      parse_scene("box.size = [9, 9]\nparticles.count = 9\nshear.rate = 1\n", "s.toml");
  View view;
  view.field = Quantity::BalanceEnergy;
  CHECK_FALSE(scene.adapted(view, {}).field.has_value());
  view.field = Quantity::Density;
  CHECK(scene.adapted(view, {}).field == Field(Quantity::Density));
}

TEST_CASE_TEMPLATE("Sheared boxes: a search finds all images near a point", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  constexpr double kRange = 1.3;
  Vec<D> box = Vec<D>::Constant(7.0);
  box[1] = 5.0;
  Domain<D> domain = sheared(periodic_box<D>(box), 1.0).domain();
  for (const double offset : {0.0, 2.9, 6.5, -20.3}) {
    CAPTURE(offset);
    domain.offset = offset;
    NearParticles<D> near(domain, kRange);
    std::vector<Vec<D>> points;
    for (std::uint32_t number = 0; number < 60; ++number) {
      Random random(9, Stream::Placement, number, 0);
      Vec<D>& point = points.emplace_back();
      for (int axis = 0; axis < D; ++axis) point[axis] = box[axis] * random.uniform();
      near.add(point);
    }
    for (const Vec<D>& point : points) {
      std::size_t found = 0, wanted = 0;
      near.visit(point, [&](std::uint32_t, const Vec<D>& way) { found += way.norm() < kRange; });
      for (const Vec<D>& other : points) {
        for (const double up : {-1.0, 0.0, 1.0}) {
          Vec<D> way = other - point;
          way[0] += up * offset;
          for (int axis = 0; axis < D; ++axis) {
            if (axis != 1) way[axis] -= box[axis] * std::round(way[axis] / box[axis]);
          }
          way[1] += up * box[1];
          wanted += way.norm() < kRange;
        }
      }
      CHECK(found == wanted);
    }
  }
}

TEST_CASE("Sheared boxes: particles of a puff enter beside all images, with the flow") {
  Scene scene = parse_scene(
      "box.size = [12, 10]\nparticles.count = 40\nparticles.restitution = 0.9\nshear.rate = 0.7\n"
      "[[change]]\ntime = 12.3\npuff = { count = 8, centre = [6, 0], radius = 4, temperature = 0 "
      "}\n",
      "s.toml");
  ScheduledRun<2> run(scene, 1);
  run.run_until(12.3);
  const Simulation<2>& simulation = run.simulation();
  REQUIRE(simulation.particles().size() == 48);
  CHECK(deepest_overlap(simulation) < 1e-12);
  const State<2> state = simulation.state();
  for (std::size_t i = 40; i < 48; ++i) {
    CHECK(state.velocities[i].x() == doctest::Approx(0.7 * (state.positions[i].y() - 5.0)));
    CHECK(state.velocities[i].y() == 0.0);
  }
  run.run_until(40.0);
  CHECK(deepest_overlap(simulation) < 1e-12);
}

namespace {

// Losses of smooth particles, from the velocities at contact.
template <int D>
class Losses : public Observer<D> {
 public:
  explicit Losses(const Model<D>& model) : model_(model) {}
  void on_collision(const PairCollision<D>& collision) override {
    const Vec<D> n = collision.separation.normalized();
    Vec<D> g = collision.particles[0].velocity - collision.particles[1].velocity;
    g[0] += *model_.shear_rate * collision.separation[1];
    const double normal = g.dot(n);
    sum += 0.25 * (1.0 - model_.restitution * model_.restitution) * normal * normal;
  }
  double sum = 0.0;

 private:
  const Model<D>& model_;
};

}  // namespace

TEST_CASE_TEMPLATE("Sheared boxes: the work of the shear is the energy gained and dissipated",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  for (const double restitution : {0.8, 1.0}) {
    CAPTURE(restitution);
    const Vec<D> box = Vec<D>::Constant(D == 2 ? 12.0 : 6.0);
    const Model<D> model = sheared(inelastic(periodic_box<D>(box), restitution), 0.7);
    Simulation<D> simulation(model, gas_in_flow<D>(model, 40));
    Totals<D> totals(simulation);
    Losses<D> losses(model);
    const Observation<D> of_totals(simulation, totals), of_losses(simulation, losses);
    const double start = simulation.kinetic_energy();
    simulation.run_until(restitution < 1.0 ? 60.0 : 5.0);
    const WindowTotals<D> window = totals.close_window();
    const double end = simulation.kinetic_energy();
    const double work = -0.7 * (window.plane[2] * window.duration + window.plane[6]);
    const double scale = start + end + losses.sum;
    CHECK(std::fabs(end - start - (work - window.dissipated)) < 1e-12 * scale);
    CHECK(std::fabs(window.dissipated - losses.sum) < 1e-12 * scale);
    CHECK(totals.ledger_residual() < 1e-13);
    CHECK(work > 0.0);
    // The stress of smooth particles is symmetric.
    CHECK(std::fabs(window.plane[5] - window.plane[6]) < 1e-11 * scale);
  }
}

// 200,000 samples of a run against the exact integrals.
TEST_CASE("Sheared boxes: temperatures are exact averages over time") {
  const Model<2> model = sheared(inelastic(periodic_box(12.0, 12.0), 0.9), 0.7);
  Simulation<2> simulation(model, gas_in_flow<2>(model, 10));
  Totals<2> totals(simulation);
  const Observation<2> observation(simulation, totals);
  constexpr double kEnd = 20.0;
  constexpr int kSamples = 200000;
  Vec2 squares = Vec2::Zero();
  double cross = 0.0;
  for (int sample = 0; sample < kSamples; ++sample) {
    simulation.run_until((sample + 0.5) * kEnd / kSamples);
    for (const Particle<2>& particle : simulation.particles()) {
      const Vec2 c = simulation.peculiar_at(particle.flight, simulation.base_time());
      squares += c.cwiseAbs2() / kSamples;
      cross += c.x() * c.y() / kSamples;
    }
  }
  simulation.run_until(kEnd);
  const WindowTotals<2> window = totals.close_window();
  for (const int axis : {0, 1}) {
    CHECK(window.temperature[axis] == doctest::Approx(0.1 * squares[axis]).epsilon(2e-4));
  }
  CHECK(window.plane[1] == doctest::Approx(cross).epsilon(2e-3));
  CHECK(window.plane[0] == doctest::Approx(squares.x()).epsilon(2e-4));
}

}  // namespace clatter::sheared_boxes
