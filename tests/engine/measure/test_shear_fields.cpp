#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/totals.h"
#include "tests/engine/measure/sums.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/models.h"
#include "tests/support/dimensions.h"

// Fields of a sheared box: velocities without the flow, in the cells of the box at rest.

namespace clatter::shear_fields {

using namespace clatter::testing;

static Grid of_run(Simulation<2>& simulation, const IntVec<2>& cells, double duration) {
  CellIntegrals<2> integrals(simulation, cells, full_layout());
  const Observation<2> observation(simulation, integrals);
  simulation.run_until(duration);
  return close(integrals);
}

// From (2, 7) upwards at 1 in a box of 10 x 8 with the rate 0.5: at t = 1 it is at the border,
// where the image above, which has moved by 4, has its x = 8. Without the flow v_x = -0.5 (y - 4) =
// -1.5 - t/2 before, and -2 - (t - 1)/2 after, where the particle flies at -4 along x in the box.
TEST_CASE("Shear fields: a flight across the border by hand") {
  Simulation<2> simulation(sheared(periodic_box(10.0, 8.0), 0.5), {{{2.0, 7.0}}, {{0.0, 1.0}}});
  const Grid grid = of_run(simulation, {5, 2}, 1.5);
  const auto at = [&](int column, int row) {
    return grid[static_cast<std::size_t>(column + 5 * row)];
  };
  // Before: x = 2, in column 1 of the upper row.
  CHECK(at(1, 1).count == doctest::Approx(1.0));
  CHECK(at(1, 1).velocity.x() == doctest::Approx(-1.75));
  CHECK(at(1, 1).velocity.y() == doctest::Approx(1.0));
  CHECK(at(1, 1).products(0, 0) == doctest::Approx((8.0 - 3.375) / 1.5));  // integral of v_x^2
  CHECK(at(1, 1).products(0, 1) == doctest::Approx(-1.75));
  // After: from x = 2 - 4 + 10 = 8 to 6, in column 3 of the lower row.
  CHECK(at(3, 0).count == doctest::Approx(0.5));
  CHECK(at(3, 0).velocity.x() == doctest::Approx(-0.5 * 2.125));
  CHECK(at(3, 0).products(0, 0) == doctest::Approx((11.390625 - 8.0) / 1.5));
  CHECK(total(grid).count == doctest::Approx(1.5));
}

// The disks of test_shear.cpp meet across the border at a known time: disk 0 is then at y = 8.327,
// beyond the border at 8, and the image of disk 1 at 7.873. The branch is cut there.
TEST_CASE("Shear fields: the transfer of a collision across the border") {
  State<2> start;
  start.positions = {{2.0, 7.8}, {5.0, 0.4}};
  start.velocities = {{0.0, 1.0}, {0.0, -1.0}};
  Simulation<2> simulation(sheared(inelastic(periodic_box(10.0, 8.0), 0.5), -0.5), start);
  const double time = (26.4 - std::sqrt(26.4 * 26.4 - 80.0 * 8.36)) / 40.0;
  const Grid grid = of_run(simulation, {5, 2}, 0.6);
  REQUIRE(simulation.counts().pair_collisions == 1);
  // From disk 1 to disk 0, and the momentum of disk 0.
  const Vec2 branch(-(3.0 - 4.0 * time), -(0.6 - 2.0 * time));
  const Vec2 approach(4.0, 2.0);
  const Vec2 momentum = -0.75 * approach.dot(branch) * branch;
  const double lost = 0.25 * 0.75 * approach.dot(branch) * approach.dot(branch);
  const Eigen::Matrix2d transfer = branch * momentum.transpose();
  CHECK(total(grid).transfer.isApprox(transfer, 1e-7));
  CHECK(total(grid).dissipation == doctest::Approx(-lost));
  // Disk 0 has y = 7.8 + t - 8 in the lower row, disk 1 is at y = 0.4 - t + 8 in the upper row.
  const double below = (7.8 + time - 8.0) / branch.y();
  // Disk 0 is at x = 2 + 4 t in the box, in column 2, and disk 1 at 5 - 4 t, in column 1.
  const Sums &lower = grid[2], &upper = grid[5 + 1];
  CHECK(lower.transfer.isApprox(below * transfer, 1e-7));
  CHECK(upper.transfer.isApprox((1.0 - below) * transfer, 1e-7));
  CHECK(lower.dissipation == doctest::Approx(-0.5 * lost));
  CHECK(upper.dissipation == doctest::Approx(-0.5 * lost));
}

// The same gas from its states at the middle of 40,000 short steps: see the test of CellIntegrals.
TEST_CASE("Shear fields: a gas agrees with sampling its states") {
  constexpr double kDuration = 4.0, kRate = 0.7;
  constexpr int kSteps = 40000;
  const IntVec<2> cells = {3, 4};
  const Model<2> model = sheared(inelastic(periodic_box(6.0, 5.0), 0.8), kRate);
  const State<2> start = gas_in_flow<2>(model, 12);
  Simulation<2> watched(model, start), sampled(model, start);
  const Grid exact = of_run(watched, cells, kDuration);
  Grid sampling(exact.size());
  const double step = kDuration / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    sampled.run_until((k + 0.5) * step);
    const State<2> state = sampled.state();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const Vec2& r = state.positions[i];
      const Vec2 c = state.velocities[i] - Vec2(kRate * (r.y() - 2.5), 0.0);
      const auto column = static_cast<std::size_t>(r.x() / 2.0);
      const auto row = static_cast<std::size_t>(r.y() / 1.25);
      Sums& cell = sampling[column + 3 * row];
      cell.count += step;
      cell.velocity += c * step;
      cell.products += c * c.transpose() * step;
      cell.energy_flux += 0.5 * c.squaredNorm() * c * step;
    }
  }
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(exact[i].count - sampling[i].count) < 1e-3);
    CHECK((exact[i].velocity - sampling[i].velocity).norm() < 5e-3);
    CHECK((exact[i].products - sampling[i].products).norm() < 2.5e-2);
    CHECK((exact[i].energy_flux - sampling[i].energy_flux).norm() < 5e-2);
  }
}

TEST_CASE("Shear fields: cells add up to the integrals of the whole box") {
  const Model<2> model = sheared(inelastic(periodic_box(9.0, 8.0), 0.8), -1.3);
  Simulation<2> simulation(model, gas_in_flow<2>(model, 30));
  CellIntegrals<2> integrals(simulation, {5, 3}, full_layout());
  CellIntegrals<2> samples(simulation, {5, 3}, full_layout(), {Estimator::Snapshot, {}});
  Totals<2> totals(simulation);
  const Observation<2> of_integrals(simulation, integrals), of_samples(simulation, samples),
      of_totals(simulation, totals);
  double begin = 0.0;
  for (const double end : {0.01, 20.0, 21.0, 60.0}) {
    simulation.run_until(end);
    const double span = end - begin;
    const Sums sum = total(close(integrals));
    const WindowTotals<2> window = totals.close_window();
    CHECK(sum.count == doctest::Approx(30.0 * span).epsilon(1e-10));
    CHECK(sum.squares().isApprox(window.temperature * 30.0 * span, 1e-9));
    CHECK(sum.products(0, 1) == doctest::Approx(window.plane[1] * span).epsilon(1e-9));
    for (int k = 0; k < 4; ++k) {
      CHECK(sum.transfer(k / 2, k % 2) == doctest::Approx(window.plane[4 + k]).epsilon(1e-9));
    }
    CHECK(sum.dissipation == doctest::Approx(-window.dissipated).epsilon(1e-9));
    // A sample has the sums of this instant.
    samples.close_window();
    samples.sample();
    const Sums sample = total(grid_of(samples.close_window(), samples.layout()));
    CHECK(0.5 * sample.squares().sum() == doctest::Approx(simulation.kinetic_energy()));
    begin = end;
  }
}

}  // namespace clatter::shear_fields
