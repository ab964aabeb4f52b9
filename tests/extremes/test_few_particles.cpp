#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/physics/collision.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Tracks every pair between collisions, through every image.
class GapWatch : public Observer<2> {
 public:
  explicit GapWatch(const Simulation<2>& simulation) : simulation_(simulation) {}
  double least_gap = kInfinity;  // between surfaces, at any time
  double widest_contact = 0.0;   // gap at a collision
  double longest_flight = 0.0;   // box lengths

  void on_collision(const PairCollision<2>& c) override {
    widest_contact = std::max(widest_contact, c.separation.norm() - 1.0);
    for (const ParticleChange<2>& particle : c.particles) follow(particle.particle, c.time);
  }

 private:
  void follow(std::uint32_t i, double end) {
    for (std::uint32_t j = 0; j < simulation_.particles().size(); ++j) {
      if (j == i) continue;
      const Flight<2>&a = simulation_.particles()[i].flight, &b = simulation_.particles()[j].flight;
      const double begin = std::max(a.time, b.time);
      look(a.at(begin, Vec2::Zero()) - b.at(begin, Vec2::Zero()), a.v - b.v, end - begin);
    }
  }

  // The whole numbers k of box lengths with low <= x + k box <= high for an x of the range.
  static std::pair<double, double> images(double x_low, double x_high, double box) {
    return {std::ceil((-1.0 - x_high) / box), std::floor((1.0 - x_low) / box)};
  }

  void look(const Vec2& x, const Vec2& v, double duration) {
    const Vec2& box = simulation_.model().box;
    const Vec2 way = v * duration;
    longest_flight = std::max(longest_flight, way.cwiseQuotient(box).cwiseAbs().maxCoeff());
    const auto [first, last] =
        images(x.x() + std::min(0.0, way.x()), x.x() + std::max(0.0, way.x()), box.x());
    for (double kx = first; kx <= last; ++kx) {
      // An image one diameter away along x may be near along y.
      const double at = x.x() + kx * box.x();
      const double into = (-at - std::copysign(1.0, v.x())) / v.x();
      const double out = (-at + std::copysign(1.0, v.x())) / v.x();
      const double y_in = x.y() + v.y() * std::clamp(into, 0.0, duration);
      const double y_out = x.y() + v.y() * std::clamp(out, 0.0, duration);
      const auto [lowest, highest] = images(std::min(y_in, y_out), std::max(y_in, y_out), box.y());
      for (double ky = lowest; ky <= highest; ++ky) {
        const Vec2 image = x + Vec2(kx * box.x(), ky * box.y());
        const double nearest = std::clamp(-image.dot(v) / v.squaredNorm(), 0.0, duration);
        least_gap = std::min(least_gap, (image + v * nearest).norm() - 1.0);
      }
    }
  }

  const Simulation<2>& simulation_;
};

}  // namespace

TEST_CASE(
    "Few particles: two and three particles whose flights are longer than the box" *
    doctest::description("no image missed: gap >= -1e-9 between all collisions, against brute "
                         "force over all images")) {
  double least = kInfinity, widest = 0.0, longest = 0.0;
  for (const int count : {2, 3}) {
    for (const Vec2& box : {Vec2(23.0, 21.0), Vec2(170.0, 160.0), Vec2(1000.0, 3.0)}) {
      const Model<2> model = periodic_box(box.x(), box.y());
      Simulation<2> simulation(model, random_gas(model, count, 920));
      GapWatch watch(simulation);
      simulation.add_observer(watch);
      simulation.run_until(kNever, 300);
      least = std::min(least, watch.least_gap);
      widest = std::max(widest, watch.widest_contact);
      longest = std::max(longest, watch.longest_flight);
      CHECK(simulation.checks().clock_steps_back < 1e-13);
    }
  }
  MESSAGE("least gap ", brief(least), ", at collisions at most ", brief(widest),
          ", longest flight between collisions ", brief(longest), " boxes");
  CHECK(longest > 100.0);
  CHECK(least >= -1e-9);
  CHECK(widest <= 1e-9);
}

TEST_CASE(
    "Few particles: none to three particles between walls of every kind, under all that acts" *
    doctest::description("they come to the end or to a rest; all numbers finite, overlap "
                         "below 1e-9")) {
  double deepest = 0.0;
  const std::optional<Wall> walls[] = {std::nullopt, kStatic,   kLossy,      kDriven,
                                       kThermal,     kSawtooth, kSinusoidal, kRoughDriven};
  for (const auto& wall : walls) {
    for (int features = 0; features < 8; ++features) {
      Model<2> model = rough(periodic_box(7.0, 6.0), 0.3, 0.5);
      if (wall) model = with_walls(with_walls(model, 0, *wall), 1, *wall);
      model.restitution = 0.9;
      if (features & 1) model.gravity = {0.2, -1.0};
      if (features & 2) model.bulk_drive = BulkDrive{0.3, 0.2, 0.1};
      if (features & 4) model.contact_time = 1e-3;
      for (int count = 0; count <= 3; ++count) {
        CAPTURE(features);
        CAPTURE(count);
        if (wall) CAPTURE(static_cast<int>(wall->kind));
        Simulation<2> simulation(model, clear_gas(model, count, 901));
        const std::string stop = stop_of(simulation, 50.0);
        // Grains may come to rest under gravity. With t_c the run continues.
        CHECK_MESSAGE((stop.empty() || (features & 5) == 1), stop);
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

TEST_CASE("Few particles: kicks of one particle, and of two" *
          doctest::description("of one nothing, of two opposite: momentum 0 within 1e-13")) {
  Model<2> model = periodic_box(7.0, 6.0);
  model.bulk_drive = BulkDrive{0.3, 0.2, 0.0};
  const State<2> one = random_gas(model, 1, 902);
  Simulation<2> alone(model, one);
  alone.run_until(10.0);
  CHECK(alone.counts().kicks == 33);
  CHECK(alone.state().velocities[0] == one.velocities[0]);
  Simulation<2> both(model, random_gas(model, 2, 902));
  both.run_until(10.0);
  MESSAGE("momentum ", brief(momentum(both.state()).norm()));
  CHECK(momentum(both.state()).norm() < 1e-13);
}

TEST_CASE("Few particles: rough particles touch through images that are not the nearest" *
          doctest::description("same bits as brute force; contacts within 1e-12 of a diameter")) {
  // In a box lower than two diameters: each collision is complete, through any image. The
  // separation is one diameter, and the loss follows theory 3.6.
  class Images : public Observer<2> {
   public:
    explicit Images(const Model<2>& model) : model_(model) {}
    int far = 0;
    double longest = 0.0;
    double worst_loss = 0.0;
    void on_collision(const PairCollision<2>& c) override {
      far += std::fabs(separation_at_prediction(c).y()) > 0.5 * model_.box.y();
      longest = std::max(longest, std::fabs(c.separation.norm() - 1.0));
      const ContactLaw law{model_.restitution, kInfinity, 0.5};
      const double loss =
          dissipated_energy<2>(c.separation, c.particles[0].velocity - c.particles[1].velocity,
                               c.particles[0].spin + c.particles[1].spin, law, model_.inertia, 1.0);
      const double lost = -(c.particles[0].energy + c.particles[1].energy);
      worst_loss = std::max(worst_loss, std::fabs(lost - loss));
    }

   private:
    // Separation through the touching image, at the start of the later of the two flights.
    static Vec2 separation_at_prediction(const PairCollision<2>& c) {
      const Flight<2>&a = c.particles[0].before, &b = c.particles[1].before;
      const double time = std::max(a.time, b.time);
      const Vec2 shift = c.separation - (c.particles[0].position - c.particles[1].position);
      return a.at(time, Vec2::Zero()) - b.at(time, Vec2::Zero()) + shift;
    }
    const Model<2>& model_;
  };
  for (const double height : {1.2, 2.05}) {
    CAPTURE(height);
    Model<2> model = rough(with_walls(periodic_box(12.0, height), 0, kDriven), kInfinity, 0.5);
    model.restitution = 0.95;
    const State<2> start = random_gas(model, 6, 903);
    Simulation<2> simulation(model, start);
    Images images(model);
    simulation.add_observer(images);
    const BaseMoves<2> moves(simulation);
    Reference<2> reference(model, start, moves);
    simulation.run_until(kNever, 3000);
    reference.run_until_collisions(3000);
    CHECK(simulation.state_hash() == state_hash<2>(reference.state()));
    MESSAGE(images.far, " of ", simulation.counts().pair_collisions,
            " collisions through such images, contacts off by ", brief(images.longest));
    CHECK(images.far > 50);
    CHECK(images.longest < 1e-12);
    CHECK(images.worst_loss < 1e-11);
    CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
    check_sound(simulation);
  }
}

TEST_CASE("Few particles: no particle, and one particle between four walls" *
          doctest::description("back at its start after ten periods within 1e-12")) {
  Simulation<2> none(periodic_box(10.0, 10.0), State<2>{});
  none.run_until(1000.0);
  none.run_until(kNever, 1);
  CHECK(none.time() == 1000.0);
  CHECK(none.kinetic_energy() == 0.0);
  CHECK(none.state().positions.empty());

  State<2> start;
  start.positions = {{5.0, 5.0}};
  start.velocities = {{1.0, 0.25}};
  const Model<2> walled = with_walls(with_walls(periodic_box(10.0, 10.0), 0, Wall{}), 1, Wall{});
  Simulation<2> one(walled, start);
  one.run_until(180.0);  // back and forth over 9: 10 periods along x, 2.5 along y
  CHECK(one.counts().wall_collisions == 25);
  const double off = (one.state().positions[0] - Vec2(5.0, 5.0)).norm();
  MESSAGE("off by ", brief(off));
  CHECK(off < 1e-12);
  CHECK(one.state().velocities[0] == Vec2(1.0, -0.25));
  check_sound(one);
}

TEST_CASE("Few particles: a free flight through many boxes" *
          doctest::description("place within two roundings of the way")) {
  double worst = 0.0;
  for (const Vec2& v : {Vec2(1234.5, -0.375), Vec2(-3.0, 77.25), Vec2(-0.001, 0.0)}) {
    State<2> start;
    start.positions = {{2.25, 3.5}};
    start.velocities = {v};
    const Model<2> model = periodic_box(7.5, 5.0);
    Simulation<2> simulation(model, start);
    simulation.run_until(1234.75);
    const Vec2 r = simulation.state().positions[0];
    for (int k = 0; k < 2; ++k) {
      // Twice the rounding error of the path, from which whole box lengths are subtracted.
      const double way = start.positions[0][k] + v[k] * 1234.75;
      const double off = std::remainder(r[k] - way, model.box[k]);
      CHECK(std::fabs(off) <= 0x1p-52 * std::fabs(way));
      worst = std::max(worst, std::fabs(off / way));
    }
    CHECK(finite_and_inside(model, simulation.state()));
    check_sound(simulation);
  }
  MESSAGE("off by ", brief(worst), " of the way");
}

TEST_CASE("Few particles: particles in contact that move alike through thousands of boxes" *
          doctest::description("they never collide, overlap below 1e-10")) {
  State<2> start;
  start.positions = {{1.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}};
  start.velocities = {{50.0, -31.0}, {50.0, -31.0}, {50.0, -31.0}};
  Simulation<2> simulation(periodic_box(4.0, 6.0), start);
  simulation.run_until(1000.0);
  CHECK(simulation.counts().pair_collisions == 0);
  CHECK(simulation.counts().cell_crossings > 20000);
  MESSAGE("overlap ", brief(simulation.deepest_overlap()));
  CHECK(simulation.deepest_overlap() < 1e-10);  // positions at 1000 are of order 5e4
}
