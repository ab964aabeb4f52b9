#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "engine/dynamics/collision_rules.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/support/dimensions.h"

namespace clatter::sliding_walls {

using namespace clatter::testing;

// Walls whose surface exchanges momentum along itself, and one that does not.
const Wall kRough{.restitution = 0.8,
                  .roughness = {.friction = 0.4, .tangential_restitution = 0.6}};

template <int D>
Vec<D> random_vector(Random& random) {
  Vec<D> vector;
  for (double& component : vector) component = random.normal();
  return vector;
}

// A random hit of a floor, the normal of which is along y.
template <int D>
Arrival<D> random_arrival(std::uint32_t number) {
  Random random(7, Stream::Velocity, number, D);
  Arrival<D> arrival{.velocity = random_vector<D>(random), .flight = number, .grain = {}};
  for (double& component : arrival.spin) component = random.normal();
  arrival.velocity[1] = -std::fabs(arrival.velocity[1]);
  return arrival;
}

template <int D>
Model<D> spinning() {
  Model<D> model = periodic_box<D>(Vec<D>::Constant(10.0));
  model.spins = true;
  return model;
}

TEST_CASE_TEMPLATE("Sliding walls: in the frame of the surface they are walls at rest", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = spinning<D>();
  const Vec<D> normal = Vec<D>::Unit(1);
  for (const Wall& rest : {kRough, kRoughDriven, kThermal}) {
    Wall slides = rest;
    slides.surface_velocity = {1.7, 0.0, D == 3 ? -0.6 : 0.0};
    const Vec<D> surface = slides.surface<D>();
    double farthest = 0.0, change = 0.0;
    for (std::uint32_t number = 0; number < 2000; ++number) {
      const Arrival<D> arrival = random_arrival<D>(number);
      Arrival<D> seen = arrival;
      seen.velocity -= surface;
      const Departure<D> moved = wall_outcome<D>(model, slides, normal, {}, arrival, false);
      const Departure<D> still = wall_outcome<D>(model, rest, normal, {}, seen, false);
      const Departure<D> unmoved = wall_outcome<D>(model, rest, normal, {}, arrival, false);
      farthest = std::max(farthest, (moved.velocity - still.velocity - surface).norm());
      farthest = std::max(farthest, (moved.spin - still.spin).norm());
      change = std::max(change, (moved.velocity - unmoved.velocity).norm());
    }
    CHECK(farthest < 1e-13);
    CHECK(change > 0.1);
  }
}

// A perfectly rough disk with q = 1/2 falls on a floor that slides at u = 3. Its surface slips at
// g = 1 - 3 + (1/2) n x 0 = -2; eta = q/(1 + q) = 1/3, so v_x' = 1 + 2/3 2 = 7/3 and
// omega' = (4 eta/q) n x g = (8/3)(0 g_y - 1 g_x) = 16/3.
TEST_CASE("Sliding walls: a disk on a perfectly rough floor, by hand") {
  Wall floor{.roughness = {.friction = kInfinity, .tangential_restitution = 1.0}};
  floor.surface_velocity = {3.0, 0.0, 0.0};
  const Arrival<2> arrival{.velocity = {1.0, -2.0}, .grain = {}};
  const Departure<2> after =
      wall_outcome<2>(spinning<2>(), floor, Vec2::Unit(1), {}, arrival, false);
  CHECK(after.velocity.x() == doctest::Approx(7.0 / 3.0).epsilon(1e-15));
  CHECK(after.velocity.y() == 2.0);
  CHECK(after.spin[0] == doctest::Approx(16.0 / 3.0).epsilon(1e-15));
}

TEST_CASE("Sliding walls: a smooth one passes no momentum along itself") {
  Wall floor = kLossy;
  floor.surface_velocity = {3.0, 0.0, 0.0};
  for (std::uint32_t number = 0; number < 100; ++number) {
    const Arrival<2> arrival = random_arrival<2>(number);
    const Departure<2> slides =
        wall_outcome<2>(spinning<2>(), floor, Vec2::Unit(1), {}, arrival, false);
    const Departure<2> rests =
        wall_outcome<2>(spinning<2>(), kLossy, Vec2::Unit(1), {}, arrival, false);
    CHECK(slides.velocity == rests.velocity);
    CHECK(slides.spin == rests.spin);
  }
}

TEST_CASE("Sliding walls: a change of the velocity keeps flights, and a checkpoint the bits") {
  Model<2> model = inelastic(with_walls(periodic_box(9.0, 8.0), 1, kThermal), 0.9);
  model.walls[kTop]->surface_velocity = {2.0, 0.0, 0.0};
  const State<2> start = clear_gas(model, 20, 81);
  Simulation<2> simulation(model, start);
  run_beside_reference(simulation, start, 2000);
  check_sound(simulation);
  Model<2> faster = model;
  faster.walls[kTop]->surface_velocity = {3.0, 0.0, 0.0};
  CHECK(keeps_flights<2>(model, faster));
}

}  // namespace clatter::sliding_walls
