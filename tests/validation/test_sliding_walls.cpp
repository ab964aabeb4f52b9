// Gases between walls that slide along themselves (theory 4.9).

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/dimensions.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

namespace clatter::sliding_walls {

using namespace clatter::testing;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// In a perfectly rough hit the wall's work u.dp is the particle's gain of energy.
TEST_CASE_TEMPLATE("Sliding walls: the power is that of the shear stress, and the ledger closes",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = gas(VecX::Constant(D, D == 2 ? 10.0 : 6.0), 40, 0.8);
  for (const double sign : {-1.0, 1.0}) {
    Wall wall{.roughness = {.friction = kInfinity, .tangential_restitution = 1.0}};
    wall.surface_velocity = {sign, 0.0, D == 3 ? 0.5 * sign : 0.0};
    scene.walls[sign < 0.0 ? kBottom : kTop] = wall;
  }
  const Measured measured = run(scene, 10.0, 50.0, 3);
  const double area = std::pow(scene.box[0], D - 1);
  double power = 0.0, size = 0.0;
  for (const int side : {kBottom, kTop}) {
    for (const int axis : {0, 2}) {
      if (axis >= D) continue;
      const auto k = static_cast<std::size_t>(axis);
      const double force = measured.shear_stress[side][k]->mean * area;
      power -= force * scene.walls[side]->surface_velocity[k];
      size += std::fabs(force);
    }
    CHECK_FALSE(measured.shear_stress[side][1]);
  }
  CHECK(measured.walls_in->mean == doctest::Approx(power).epsilon(1e-12 * size / power));
  CHECK(power > 0.0);
  CHECK(measured.ledger_residual < 1e-14);
}

// Momentum is conserved, so the stress sigma_xy is the same at all heights, and the walls exert it.
// The gas slips at the walls. 12 rows; the averages are over 4000 time units. The walls touch
// centres half a diameter away, so a quarter of a row at a wall has no stress.
TEST_CASE("Sliding walls: the shear stress is flat across a Couette flow") {
  Scene scene = gas(30.0, 24.0, 200, 0.95);
  Wall top{.kind = WallKind::Thermal, .temperature = 0.5};
  top.surface_velocity = {2.0, 0.0, 0.0};
  Wall bottom = top;
  bottom.surface_velocity = {-2.0, 0.0, 0.0};
  scene.walls[kBottom] = bottom;
  scene.walls[kTop] = top;
  scene.measure.fields = {Field(Quantity::Velocity, 0), Field(Quantity::Stress, 0, 1)};
  scene.measure.profile_axis = Axis::Y;
  scene.measure.cells = {1, 12};
  const Measured measured = run(scene, 300.0, 4000.0, 5);
  const auto& velocity = measured.profile->at(Field(Quantity::Velocity, 0));
  const auto& stress = measured.profile->at(Field(Quantity::Stress, 0, 1));
  for (std::size_t row = 0; row + 1 < velocity.size(); ++row) {
    CAPTURE(row);
    CHECK(velocity[row].mean < velocity[row + 1].mean);
  }
  CHECK(velocity.front().mean > -2.0);
  CHECK(velocity.back().mean < 2.0);
  const Estimate &below = *measured.shear_stress[kBottom][0],
                 &above = *measured.shear_stress[kTop][0];
  MESSAGE("stress of the walls ", -below.mean, " +- ", below.standard_error, ", ", above.mean,
          " +- ", above.standard_error);
  CHECK(below.standard_error < 0.02 * std::fabs(below.mean));
  CHECK(std::fabs(below.mean + above.mean) <
        5.0 * std::hypot(below.standard_error, above.standard_error));
  // The gas drags the top wall back, so that sigma_xy > 0.
  CHECK(above.mean < 0.0);
  for (std::size_t row = 0; row < stress.size(); ++row) {
    CAPTURE(row);
    const bool at_wall = row == 0 || row + 1 == stress.size();
    const double expected = (at_wall ? -0.75 : -1.0) * above.mean;
    CHECK(std::fabs(stress[row].mean - expected) <
          5.0 * std::hypot(stress[row].standard_error, above.standard_error));
  }
  check_energy_balance(measured, 200);
}

}  // namespace clatter::sliding_walls
