#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/physics/collision.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Tracks every pair between collisions, through every image.
template <int D>
class GapWatch : public Observer<D> {
 public:
  explicit GapWatch(const Simulation<D>& simulation) : simulation_(simulation) {}
  double least_gap = kInfinity;  // between surfaces, at any time
  double widest_contact = 0.0;   // gap at a collision
  double longest_flight = 0.0;   // box lengths

  void on_collision(const PairCollision<D>& c) override {
    widest_contact = std::max(widest_contact, c.separation.norm() - 1.0);
    for (const ParticleChange<D>& particle : c.particles) follow(particle.particle, c.time);
  }

 private:
  void follow(std::uint32_t i, double end) {
    for (std::uint32_t j = 0; j < simulation_.particles().size(); ++j) {
      if (j == i) continue;
      const Flight<D>&a = simulation_.particles()[i].flight, &b = simulation_.particles()[j].flight;
      const double begin = std::max(a.time, b.time);
      const Vec<D> x = a.at(begin, Vec<D>::Zero()) - b.at(begin, Vec<D>::Zero()), v = a.v - b.v;
      const Vec<D> boxes = (v * (end - begin)).cwiseQuotient(simulation_.model().box);
      longest_flight = std::max(longest_flight, boxes.cwiseAbs().maxCoeff());
      look(x, v, 0.0, end - begin, 0);
    }
  }

  // Each image that comes within a diameter along `axis` between two times, and then along the next
  // axis while it does.
  void look(const Vec<D>& x, const Vec<D>& v, double from, double to, int axis) {
    if (axis == D) {
      const double nearest = std::clamp(-x.dot(v) / v.squaredNorm(), from, to);
      least_gap = std::min(least_gap, (x + v * nearest).norm() - 1.0);
      return;
    }
    const double box = simulation_.model().box[axis], speed = v[axis];
    const double begin = x[axis] + speed * from, end = x[axis] + speed * to;
    const double last = std::floor((1.0 - std::min(begin, end)) / box);
    for (double k = std::ceil((-1.0 - std::max(begin, end)) / box); k <= last; ++k) {
      Vec<D> image = x;
      image[axis] += k * box;
      const double into = (-image[axis] - std::copysign(1.0, speed)) / speed;
      const double out = (-image[axis] + std::copysign(1.0, speed)) / speed;
      look(image, v, std::clamp(into, from, to), std::clamp(out, from, to), axis + 1);
    }
  }

  const Simulation<D>& simulation_;
};

template <int D>
void check_long_flights(const std::vector<Vec<D>>& boxes) {
  double least = kInfinity, widest = 0.0, longest = 0.0;
  for (const int count : {2, 3}) {
    for (const Vec<D>& box : boxes) {
      const Model<D> model = periodic_box<D>(box);
      Simulation<D> simulation(model, random_gas(model, count, 920));
      GapWatch<D> watch(simulation);
      simulation.add_observer(watch);
      simulation.run_until(kNever, 300);
      least = std::min(least, watch.least_gap);
      widest = std::max(widest, watch.widest_contact);
      longest = std::max(longest, watch.longest_flight);
      CHECK(simulation.checks().clock_steps_back < 1e-13);
    }
  }
  MESSAGE("smallest gap ", brief(least), ", largest gap at a collision ", brief(widest),
          ", longest flight between collisions ", brief(longest), " boxes");
  CHECK(longest > 100.0);
  CHECK(least >= -1e-9);
  CHECK(widest <= 1e-9);
}

template <int D>
void check_all_walls(const Vec<D>& box, const Vec<D>& gravity) {
  double deepest = 0.0;
  const std::optional<Wall> walls[] = {std::nullopt, kStatic,   kLossy,      kDriven,
                                       kThermal,     kSawtooth, kSinusoidal, kRoughDriven};
  for (const auto& wall : walls) {
    for (int features = 0; features < 8; ++features) {
      Model<D> model = rough(periodic_box<D>(box), 0.3, 0.5);
      if (wall) model = walled(model, *wall);
      model.restitution = 0.9;
      if (features & 1) model.gravity = gravity;
      if (features & 2) model.bulk_drive = BulkDrive{0.3, 0.2, 0.1};
      if (features & 4) model.contact_time = 1e-3;
      for (int count = 0; count <= 3; ++count) {
        CAPTURE(features);
        CAPTURE(count);
        if (wall) CAPTURE(static_cast<int>(wall->kind));
        Simulation<D> simulation(model, clear_gas(model, count, 901));
        const std::string stop = stop_of(simulation, 50.0);
        // Grains may come to rest under gravity, or on a wall that accelerates inward. With t_c the
        // run continues.
        const bool rests = features & 1 || (wall && wall->kind == WallKind::Sinusoidal);
        CHECK_MESSAGE((stop.empty() || (rests && !(features & 4))), stop);
        if (stop.empty()) {
          CHECK(simulation.time() == 50.0);
          CHECK(simulation.counts().kicks == (features & 2 ? 166 : 0));
        }
        CHECK(finite_and_inside(model, simulation.state()));
        CHECK(simulation.deepest_overlap() < 1e-9);
        CHECK(simulation.checks().deepest_overlap < 1e-9);
        deepest = std::max(deepest, simulation.checks().deepest_overlap);
      }
    }
  }
  MESSAGE("deepest overlap ", brief(deepest));
}

template <int D>
void check_kicks(const Vec<D>& box) {
  Model<D> model = periodic_box<D>(box);
  model.bulk_drive = BulkDrive{0.3, 0.2, 0.0};
  const State<D> one = random_gas(model, 1, 902);
  Simulation<D> alone(model, one);
  alone.run_until(10.0);
  CHECK(alone.counts().kicks == 33);
  CHECK(alone.state().velocities[0] == one.velocities[0]);
  Simulation<D> both(model, random_gas(model, 2, 902));
  both.run_until(10.0);
  MESSAGE("momentum ", brief(momentum(both.state()).norm()));
  CHECK(momentum(both.state()).norm() < 1e-13);
}

}  // namespace

TEST_CASE("Few particles: two and three particles whose flights are longer than the box" *
          doctest::description("no collision with a periodic image is missed: gap >= -1e-9 at all "
                               "times, by brute force over all images")) {
  check_long_flights<2>({{23.0, 21.0}, {170.0, 160.0}, {1000.0, 3.0}});
}

TEST_CASE("Few particles: two and three spheres whose flights are longer than the box" *
          doctest::description("no collision with a periodic image is missed: gap >= -1e-9 at all "
                               "times, by brute force over all images")) {
  check_long_flights<3>({{9.0, 8.0, 7.0}, {25.0, 24.0, 23.0}, {200.0, 3.0, 2.5}});
}

TEST_CASE(
    "Few particles: none to three particles between walls of every kind, with every combination of "
    "forces" *
    doctest::description("the run ends, or stops when particles come to rest; all numbers finite, "
                         "overlap below 1e-9")) {
  check_all_walls<2>({7.0, 6.0}, {0.2, -1.0});
}

TEST_CASE(
    "Few particles: none to three spheres between six walls of every kind, with every combination "
    "of forces" *
    doctest::description("the run ends, or stops when particles come to rest; all numbers finite, "
                         "overlap below 1e-9")) {
  check_all_walls<3>({4.0, 5.0, 4.5}, {0.2, -1.0, 0.3});
}

TEST_CASE("Few particles: kicks of a gas of one particle, and of two" *
          doctest::description(
              "one particle keeps its velocity; two get opposite kicks: momentum 0 within 1e-13")) {
  check_kicks<2>({7.0, 6.0});
  check_kicks<3>({7.0, 6.0, 5.0});
}

namespace {

// Counts collisions through images that were not the nearest when they were predicted.
template <int D>
class Images : public Observer<D> {
 public:
  explicit Images(const Model<D>& model) : model_(model) {}
  int far = 0;
  double longest = 0.0;
  double worst_loss = 0.0;
  void on_collision(const PairCollision<D>& c) override {
    far += (separation_at_prediction(c).cwiseAbs().array() > 0.5 * model_.box.array()).any();
    longest = std::max(longest, std::fabs(c.separation.norm() - 1.0));
    const ContactLaw law{model_.restitution, kInfinity, 0.5};
    const double loss =
        dissipated_energy<D>(c.separation, c.particles[0].velocity - c.particles[1].velocity,
                             0.5 * (c.particles[0].spin + c.particles[1].spin), law,
                             {c.particles[0].grain, c.particles[1].grain});
    const double lost = -(c.particles[0].energy() + c.particles[1].energy());
    worst_loss = std::max(worst_loss, std::fabs(lost - loss));
  }

 private:
  // Separation through the touching image, at the start of the later of the two flights. 0 along
  // walled axes.
  Vec<D> separation_at_prediction(const PairCollision<D>& c) const {
    const Flight<D>&a = c.particles[0].before, &b = c.particles[1].before;
    const double time = std::max(a.time, b.time);
    const Vec<D> shift = c.separation - (c.particles[0].position - c.particles[1].position);
    Vec<D> x = a.at(time, Vec<D>::Zero()) - b.at(time, Vec<D>::Zero()) + shift;
    for (int axis = 0; axis < D; ++axis) x[axis] *= model_.periodic(axis);
    return x;
  }
  const Model<D>& model_;
};

// In a box lower than two diameters: each collision is complete, through any image. The separation
// is one diameter, and the loss follows theory 3.6.
template <int D>
void check_images(const Vec<D>& box, int count, std::uint64_t collisions) {
  Model<D> model = rough(with_walls(periodic_box<D>(box), 0, kDriven), kInfinity, 0.5);
  model.restitution = 0.95;
  const State<D> start = random_gas(model, count, 903);
  Simulation<D> simulation(model, start);
  Images<D> images(model);
  simulation.add_observer(images);
  run_beside_reference(simulation, start, collisions);
  MESSAGE(images.far, " of ", simulation.counts().pair_collisions,
          " collisions with these images, separation off by ", brief(images.longest));
  CHECK(images.far > 50);
  CHECK(images.longest < 1e-12);
  CHECK(images.worst_loss < 1e-11);
  CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
  check_sound(simulation);
}

// Back and forth over 9 from the middle: 10 periods along x, 2.5 along y, 5 along z.
template <int D>
void check_few() {
  Simulation<D> none(periodic_box<D>(Vec<D>::Constant(10.0)), State<D>{});
  none.run_until(1000.0);
  none.run_until(kNever, 1);
  CHECK(none.time() == 1000.0);
  CHECK(none.kinetic_energy() == 0.0);
  CHECK(none.state().positions.empty());

  const Vec<D> middle = Vec<D>::Constant(5.0);
  const Vec<D> velocity = Vec<3>(1.0, 0.25, 0.5).head<D>(), end = Vec<3>(1.0, -0.25, 0.5).head<D>();
  Simulation<D> one(walled(periodic_box<D>(Vec<D>::Constant(10.0)), kStatic),
                    State<D>{{middle}, {velocity}});
  one.run_until(180.0);
  CHECK(one.counts().wall_collisions == (D == 2 ? 25 : 35));
  const double off = (one.state().positions[0] - middle).norm();
  MESSAGE("off by ", brief(off));
  CHECK(off < 1e-12);
  CHECK(one.state().velocities[0] == end);
  check_sound(one);
}

// Off the way by at most twice its rounding error, from which whole box lengths are subtracted.
template <int D>
double check_flight(const Vec<D>& box, const Vec<D>& from, const Vec<D>& v) {
  const Model<D> model = periodic_box<D>(box);
  Simulation<D> simulation(model, State<D>{{from}, {v}});
  simulation.run_until(1234.75);
  const Vec<D> r = simulation.state().positions[0];
  double worst = 0.0;
  for (int k = 0; k < D; ++k) {
    const double way = from[k] + v[k] * 1234.75;
    const double off = std::remainder(r[k] - way, box[k]);
    CHECK(std::fabs(off) <= 0x1p-52 * std::fabs(way));
    worst = std::max(worst, std::fabs(off / way));
  }
  CHECK(finite_and_inside(model, simulation.state()));
  check_sound(simulation);
  return worst;
}

template <int D>
void check_crystallite(const Vec<D>& box, const Vec<D>& velocity) {
  State<D> start;
  for (int i = 0; i <= D; ++i) {
    start.positions.push_back(Vec<D>::Ones());
    if (i > 0) start.positions.back()[i - 1] += 1.0;
    start.velocities.push_back(velocity);
  }
  Simulation<D> simulation(periodic_box<D>(box), start);
  simulation.run_until(1000.0);
  CHECK(simulation.counts().pair_collisions == 0);
  CHECK(simulation.counts().cell_crossings > 20000);
  MESSAGE("overlap ", brief(simulation.deepest_overlap()));
  CHECK(simulation.deepest_overlap() < 1e-10);  // positions at 1000 are of order 5e4
}

}  // namespace

TEST_CASE(
    "Few particles: collisions of rough particles with periodic images that are not the nearest" *
    doctest::description(
        "the same bits as brute force; separation at contact within 1e-12 of a diameter")) {
  check_images<2>({12.0, 1.2}, 6, 3000);
  check_images<2>({12.0, 2.05}, 6, 3000);
}

TEST_CASE(
    "Few particles: collisions of rough spheres with periodic images that are not the nearest" *
    doctest::description(
        "the same bits as brute force; separation at contact within 1e-12 of a diameter")) {
  check_images<3>({8.0, 1.2, 1.3}, 5, 1000);
  check_images<3>({8.0, 1.1, 2.05}, 5, 1000);
}

TEST_CASE(
    "Few particles: no particle, and one particle between walls on all sides" *
    doctest::description("the particle is back at its start after ten periods within 1e-12")) {
  check_few<2>();
  check_few<3>();
}

TEST_CASE("Few particles: a free flight through many boxes" *
          doctest::description("position within two rounding errors of the path")) {
  double worst = 0.0;
  for (const Vec2& v : {Vec2(1234.5, -0.375), Vec2(-3.0, 77.25), Vec2(-0.001, 0.0)}) {
    worst = std::max(worst, check_flight<2>({7.5, 5.0}, {2.25, 3.5}, v));
  }
  for (const Vec<3>& v : {Vec<3>(1234.5, -0.375, 33.3), Vec<3>(-3.0, 77.25, -1e-3)}) {
    worst = std::max(worst, check_flight<3>({7.5, 5.0, 6.1}, {2.25, 3.5, 1.7}, v));
  }
  MESSAGE("off by ", brief(worst), " of the path");
}

TEST_CASE("Few particles: touching particles with equal velocities, through thousands of boxes" *
          doctest::description("no collision, overlap below 1e-10")) {
  check_crystallite<2>({4.0, 6.0}, {50.0, -31.0});
  check_crystallite<3>({4.0, 6.0, 5.0}, {50.0, -31.0, 17.0});
}
