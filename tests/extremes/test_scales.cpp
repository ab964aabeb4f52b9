#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// A particle flies along `axis` past one at rest, whose distance from the path is the length of
// `beside`, nearly 1. Relative deviation of their velocities across the path from theory 3.2: the
// impulse (1 + alpha)/2 |g_n| along n has the component (1 + alpha)/2 sqrt(1 - b^2) b across. b is
// that of the stored numbers; 1 - b^2 is computed with more digits.
template <int D>
double graze_off(int axis, const Vec<D>& beside, double distance, double speed,
                 double restitution) {
  CAPTURE(axis);
  CAPTURE(distance);
  CAPTURE(speed);
  CAPTURE(restitution);
  Vec<D> box = Vec<D>::Constant(8.0), middle = Vec<D>::Ones(), velocity = Vec<D>::Zero();
  box[axis] = 64.0;
  middle[axis] = 4.0 + distance;
  velocity[axis] = speed;
  Vec<D> from = Vec<D>::Ones() + beside;
  from[axis] = 4.0;
  Vec<D> stored = from - middle;
  stored[axis] = 0.0;
  long double depth = 1.0L;
  for (const double part : stored) depth -= static_cast<long double>(part) * part;
  REQUIRE(depth > 0.0L);
  Simulation<D> simulation(inelastic(periodic_box<D>(box), restitution),
                           State<D>{{from, middle}, {velocity, Vec<D>::Zero()}});
  simulation.run_until(kNever, 1);
  CHECK(simulation.counts().pair_collisions == 1);
  check_sound(simulation);
  const Vec<D> across =
      0.5 * (1.0 + restitution) * std::sqrt(static_cast<double>(depth)) * speed * stored;
  const State<D> state = simulation.state();
  double worst = 0.0;
  for (int i : {0, 1}) {
    Vec<D> v = (i == 0 ? 1.0 : -1.0) * state.velocities[i];
    v[axis] = 0.0;
    worst = std::max(worst, (v - across).norm() / across.norm());
  }
  return worst;
}

// `beside` is given by its direction.
template <int D>
void check_graze(const Vec<D>& direction) {
  double worst = 0.0;
  for (const double restitution : {1.0, 0.9, 0.0}) {
    for (const double distance : {1.25, 3.0, 25.0}) {
      for (const double speed : {1.0, 1e-3, 0.7e5}) {
        for (int axis = 0; axis < D; ++axis) {
          // Turned so that the component 0 of the direction is along the path.
          Vec<D> beside;
          for (int k = 0; k < D; ++k) beside[(k + axis) % D] = (1.0 - 1e-12) * direction[k];
          worst = std::max(worst, graze_off<D>(axis, beside, distance, speed, restitution));
        }
      }
    }
  }
  MESSAGE("off by ", brief(worst));
  CHECK(worst < 1e-4);
}

// Two orthogonal unit vectors of random direction.
std::pair<Vec<2>, Vec<2>> random_axes(const Random& source, std::integral_constant<int, 2>) {
  Random random = source;
  const double turn = 2.0 * std::numbers::pi * random.uniform();
  return {{std::cos(turn), std::sin(turn)}, {-std::sin(turn), std::cos(turn)}};
}
std::pair<Vec<3>, Vec<3>> random_axes(const Random& source, std::integral_constant<int, 3>) {
  Random random = source;
  Vec<3> along, other;
  for (double& component : along) component = random.normal();
  for (double& component : other) component = random.normal();
  return {along.normalized(), along.cross(other).normalized()};
}

// The discriminant is the difference of two numbers near 10^6. b is within 10^-k of grazing.
template <int D>
void check_far_meetings() {
  double worst = 0.0;
  int met = 0;
  for (int k = 1; k <= 12; ++k) {
    for (int n = 0; n < 200; ++n) {
      Random random(926, Stream::Placement, static_cast<std::uint32_t>(k),
                    static_cast<std::uint32_t>(n));
      const double beside = (n % 2 ? 1.0 : -1.0) * std::pow(10.0, -k) * random.uniform();
      const auto [along, across] = random_axes(random, std::integral_constant<int, D>());
      const Vec<D> middle = Vec<D>::Constant(1500.0);
      const Vec<D> far = middle - 1000.0 * along + (1.0 - beside) * across;
      const Model<D> model = with_walls(periodic_box<D>(Vec<D>::Constant(3000.0)), 0, kStatic);
      Simulation<D> simulation(model, State<D>{{far, middle}, {3.0 * along, Vec<D>::Zero()}});
      simulation.run_until(340.0);
      // Stored numbers have rounding errors of 2e-13 in position and 2e-16 in direction: 1e-12 over
      // the path.
      if (std::fabs(beside) > 1e-12) {
        CAPTURE(beside);
        CHECK(simulation.counts().pair_collisions == (beside > 0.0 ? 1 : 0));
      }
      met += static_cast<int>(simulation.counts().pair_collisions);
      worst = std::max({worst, simulation.checks().deepest_overlap,
                        brute_force_overlap(model, simulation.state())});
    }
  }
  MESSAGE(met, " of 2400 hit, deepest overlap ", brief(worst));
  CHECK(worst <= 1e-10);
}

template <int D>
void check_scalings() {
  const Model<D> model = everything<D>();
  const State<D> start = clear_gas(model, 20, 906);
  Simulation<D> plain(model, start);
  plain.run_until(kNever, 3000);
  for (const int length : {-40, 40}) {
    for (const int speed : {-30, 30}) {
      const double l = std::ldexp(1.0, length), s = std::ldexp(1.0, speed);
      Model<D> scaled = model;
      scaled.box *= l;
      scaled.diameter *= l;
      scaled.gravity *= s * s / l;
      scaled.bulk_drive =
          BulkDrive{model.bulk_drive->interval * (l / s), model.bulk_drive->kick_speed * s,
                    model.bulk_drive->kick_spin * (s / l)};
      scaled.contact_time = *model.contact_time * (l / s);
      for (auto& wall : scaled.walls) {
        wall->drive_speed *= s;
        wall->temperature *= s * s;
        wall->stroke *= l;
        wall->frequency *= s / l;
      }
      State<D> scaled_start = start;
      for (Vec<D>& r : scaled_start.positions) r *= l;
      for (Vec<D>& v : scaled_start.velocities) v *= s;
      for (Spin<D>& w : scaled_start.spins) w *= s / l;
      Simulation<D> simulation(scaled, scaled_start);
      simulation.run_until(kNever, 3000);
      State<D> state = simulation.state();
      for (Vec<D>& r : state.positions) r /= l;
      for (Vec<D>& v : state.velocities) v /= s;
      for (Spin<D>& w : state.spins) w /= s / l;
      CHECK(state_hash<D>(state) == plain.state_hash());
      CHECK(simulation.counts().kicks == plain.counts().kicks);
      CHECK(simulation.counts().elasticised == plain.counts().elasticised);
    }
  }
  CHECK(plain.counts().kicks > 10);
  CHECK(plain.counts().elasticised > 10);
  MESSAGE(plain.counts().collisions(), " collisions, four scalings, the same bits");
}

}  // namespace

TEST_CASE("Scales: a grazing collision with impact parameter b = 1 - 1e-12" *
          doctest::description(
              "deflection as in theory 3.2 within 1e-4, the effect of the rounding of b")) {
  check_graze<2>({0.0, 1.0});
  check_graze<3>({0.0, 0.6, 0.8});
}

TEST_CASE("Scales: particles that hit or miss each other after 1000 diameters" *
          doctest::description("separation at contact within 1e-10 of a diameter; no false hit or "
                               "miss beyond the rounding of b")) {
  check_far_meetings<2>();
  check_far_meetings<3>();
}

TEST_CASE("Scales: lengths scaled by 2^+-40 and speeds by 2^+-30, all features together" *
          doctest::description("the same bits in all runs")) {
  check_scalings<2>();
  check_scalings<3>();
}

// The first particles reach the walls late and leave them fast. Without a move of the time base,
// rounding errors of the times correspond to paths of 1e-10 diameters.
TEST_CASE("Scales: a gas of speeds 1e-4, 1e-8, 1e-12 between walls with v_dr = 1" *
          doctest::description("the same bits as brute force, overlap below 1e-12")) {
  double deepest = 0.0;
  for (const double speed : {1e-4, 1e-8, 1e-12}) {
    CAPTURE(speed);
    Model<2> model = with_walls(periodic_box(20.0, 25.0), 0, kDriven);
    model.restitution = 0.9;
    State<2> start = random_gas(model, 100, 912);
    for (Vec2& v : start.velocities) v *= speed;
    Simulation<2> simulation(model, start);
    run_beside_reference(simulation, start, 100);
    simulation.run_until(kNever, 20000);
    deepest = std::max(deepest, simulation.checks().deepest_overlap);
    check_sound(simulation);
  }
  MESSAGE("deepest overlap ", brief(deepest));
}

namespace {

// One particle of speed 1e6 among others of speed 1e-6, which it hits one after the other. Also
// with a wall that oscillates at a speed of order 1.
template <int D>
void check_fast_particle(const Vec<D>& box) {
  double energy_off = 0.0, deepest = 0.0;
  for (const bool closed : {false, true}) {
    Model<D> model = periodic_box<D>(box);
    if (closed) {
      Wall wall = kSinusoidal;
      wall.restitution = 1.0;
      model = with_walls(with_walls(model, 0, wall), 1, kStatic);
    }
    State<D> start = clear_gas(model, 12, 907);
    for (Vec<D>& v : start.velocities) v *= 1e-6;
    start.velocities[5] *= 1e12;
    Simulation<D> simulation(model, start);
    const double energy = simulation.kinetic_energy();
    run_beside_reference(simulation, start, 300);
    simulation.run_until(kNever, 20000);
    if (!closed) energy_off = std::fabs(simulation.kinetic_energy() / energy - 1.0);
    CHECK(finite_and_inside(model, simulation.state()));
    deepest =
        std::max({deepest, simulation.deepest_overlap(), simulation.checks().deepest_overlap});
  }
  MESSAGE("energy off by ", brief(energy_off), ", deepest overlap ", brief(deepest));
  CHECK(energy_off < 1e-12);
  CHECK(deepest < 1e-10);
}

}  // namespace

TEST_CASE("Scales: speeds that differ by 1e12" *
          doctest::description(
              "the same bits as brute force; energy within 1e-12, overlap below 1e-10")) {
  check_fast_particle<2>({9.0, 8.0});
  check_fast_particle<3>({4.0, 4.5, 3.5});
}
