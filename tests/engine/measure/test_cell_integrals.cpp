#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/totals.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

using Grid = std::vector<CellMoments<2>>;

/// What one disk leaves on a grid while nothing is in its way.
Grid of_lone_disk(const Vec2& box, const IntVec<2>& cells, const Vec2& r, const Vec2& v,
                  double duration) {
  const auto simulation = lone_disk(gas(box.x(), box.y(), 1, 1.0), r, v);
  CellIntegrals<2> integrals(*simulation, cells);
  simulation->add_observer(integrals);
  simulation->run_until(duration);
  return integrals.close_window();
}

/// Checks the time spent in every cell, and that each also got v and v^2 times it.
void check_times(const Grid& grid, const std::vector<double>& times, const Vec2& v) {
  REQUIRE(grid.size() == times.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(grid[i].count - times[i]) < 1e-12);
    CHECK((grid[i].velocity - v * times[i]).norm() < 1e-12);
    CHECK((grid[i].velocity_squared - v.cwiseAbs2() * times[i]).norm() < 1e-12);
  }
}

CellMoments<2> total(const Grid& grid) {
  CellMoments<2> sum;
  for (const CellMoments<2>& cell : grid) sum += cell;
  return sum;
}

/// The largest difference of any number of two grids.
double difference(const Grid& a, const Grid& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max({largest, std::fabs(a[i].count - b[i].count),
                        (a[i].velocity - b[i].velocity).cwiseAbs().maxCoeff(),
                        (a[i].velocity_squared - b[i].velocity_squared).cwiseAbs().maxCoeff()});
  }
  return largest;
}

void add(Grid& sum, const Grid& more) {
  if (sum.empty()) sum.resize(more.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

/// The same integrals by asking for the state half-way through each of many short steps.
Grid by_sampling(Simulation<2>& simulation, const IntVec<2>& cells, double duration, int steps) {
  Grid grid(static_cast<std::size_t>(cells.prod()));
  const double step = duration / steps;
  for (int k = 0; k < steps; ++k) {
    simulation.run_until((k + 0.5) * step);
    const State<2> state = simulation.state();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const Vec2 share = state.positions[i].cwiseQuotient(simulation.model().box);
      const int column = static_cast<int>(share.x() * cells.x());
      const int row = static_cast<int>(share.y() * cells.y());
      CellMoments<2>& cell = grid[static_cast<std::size_t>(column + row * cells.x())];
      cell.count += step;
      cell.velocity += state.velocities[i] * step;
      cell.velocity_squared += state.velocities[i].cwiseAbs2() * step;
    }
  }
  return grid;
}

}  // namespace

TEST_CASE("CellIntegrals: a diagonal flight is cut at every border") {
  // Borders in x at t = .75, 1.75, in y at t = .5, 1.5: cells of unit side, 3 along x, 4 along y.
  const Vec2 v = {1.0, 1.0};
  const Grid grid = of_lone_disk({3.0, 4.0}, {3, 4}, {0.25, 0.5}, v, 2.0);
  check_times(grid,
              {0.5, 0.0, 0.0,    //
               0.25, 0.75, 0.0,  //
               0.0, 0.25, 0.25,  //
               0.0, 0.0, 0.0},
              v);
}

TEST_CASE("CellIntegrals: a flight back, and through the corners of cells") {
  const Vec2 v = {-1.0, -1.0};
  const Grid grid = of_lone_disk({3.0, 4.0}, {3, 4}, {2.5, 2.5}, v, 2.25);
  check_times(grid,
              {0.75, 0.0, 0.0,  //
               0.0, 1.0, 0.0,   //
               0.0, 0.0, 0.5,   //
               0.0, 0.0, 0.0},
              v);
}

TEST_CASE("CellIntegrals: a flight over many boxes visits all cells on its line alike") {
  // In 80 time units the disk crosses the box 20 times along x and 10 times, backwards, along y.
  const Vec2 v = {1.0, -0.5};
  const Grid grid = of_lone_disk({4.0, 4.0}, {4, 4}, {0.5, 3.75}, v, 80.0);
  double sum_of_rows[4] = {}, sum_of_columns[4] = {};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    sum_of_columns[i % 4] += grid[i].count;
    sum_of_rows[i / 4] += grid[i].count;
  }
  for (int k = 0; k < 4; ++k) {
    CHECK(sum_of_columns[k] == doctest::Approx(20.0).epsilon(1e-12));
    CHECK(sum_of_rows[k] == doctest::Approx(20.0).epsilon(1e-12));
  }
  CHECK(total(grid).velocity.isApprox(v * 80.0, 1e-12));
}

TEST_CASE("CellIntegrals: a disk at rest, also on a border") {
  check_times(of_lone_disk({4.0, 2.0}, {4, 2}, {2.5, 0.5}, {0.0, 0.0}, 7.0),
              {0.0, 0.0, 7.0, 0.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.0});
  // A cell holds its lower border.
  check_times(of_lone_disk({4.0, 2.0}, {4, 2}, {2.0, 1.0}, {0.0, 0.0}, 7.0),
              {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0, 0.0}, {0.0, 0.0});
}

TEST_CASE("CellIntegrals: a disk that moves along one axis only") {
  const Vec2 v = {0.0, 2.0};
  // From y = 1.5: .75 to the top, then round.
  check_times(of_lone_disk({2.0, 3.0}, {2, 3}, {0.5, 1.5}, v, 2.0),
              {0.5, 0.0, 0.75, 0.0, 0.75, 0.0}, v);
  // Along the border x = 1 itself.
  check_times(of_lone_disk({2.0, 3.0}, {2, 3}, {1.0, 1.5}, v, 2.0),
              {0.0, 0.5, 0.0, 0.75, 0.0, 0.75}, v);
}

TEST_CASE("CellIntegrals: a disk that starts on a border counts where it goes") {
  check_times(of_lone_disk({4.0, 2.0}, {4, 1}, {2.0, 1.0}, {1.0, 0.0}, 0.5), {0.0, 0.0, 0.5, 0.0},
              {1.0, 0.0});
  check_times(of_lone_disk({4.0, 2.0}, {4, 1}, {2.0, 1.0}, {-1.0, 0.0}, 0.5), {0.0, 0.5, 0.0, 0.0},
              {-1.0, 0.0});
  // The box's own border, across which the far cells follow.
  check_times(of_lone_disk({4.0, 2.0}, {4, 1}, {0.0, 1.0}, {-1.0, 0.0}, 0.5), {0.0, 0.0, 0.0, 0.5},
              {-1.0, 0.0});
}

TEST_CASE("CellIntegrals: a window that ends on a border") {
  check_times(of_lone_disk({4.0, 2.0}, {4, 1}, {0.5, 1.0}, {1.0, 0.0}, 1.5), {0.5, 1.0, 0.0, 0.0},
              {1.0, 0.0});
}

TEST_CASE("CellIntegrals: cells whose sides are no binary fractions") {
  // 1/10 of 1.5: borders are not exact, and the disk must not fall between two cells.
  const Vec2 v = {0.3, -0.7};
  const Grid grid = of_lone_disk({1.5, 2.1}, {10, 7}, {0.45, 0.3}, v, 1000.0);
  CHECK(total(grid).count == doctest::Approx(1000.0).epsilon(1e-12));
  CHECK(std::ranges::all_of(grid, [](const auto& cell) { return cell.count >= 0.0; }));
}

TEST_CASE("CellIntegrals: a gas agrees with sampling its states") {
  // With steps of 1e-4 each of some ten border crossings of a cell is misplaced by up to half a
  // step, hence 1e-3 in time, more in v and v^2 (speeds up to 5); no single crossing more lost.
  constexpr double kDuration = 4.0;
  const IntVec<2> cells = {3, 4};
  Scene scene = gas(6.0, 5.0, 12, 0.8);
  wall_in(scene, 0, {.kind = WallKind::Driven, .drive_speed = 1.0});
  const auto watched = simulation_of(scene, 21);
  CellIntegrals<2> integrals(*watched, cells);
  watched->add_observer(integrals);
  watched->run_until(kDuration);
  const Grid exact = integrals.close_window();

  const auto sampled = simulation_of(scene, 21);
  const Grid sampling = by_sampling(*sampled, cells, kDuration, 40000);
  REQUIRE(sampled->counts().disk_wall >= 10);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(exact[i].count - sampling[i].count) < 1e-3);
    CHECK((exact[i].velocity - sampling[i].velocity).norm() < 5e-3);
    CHECK((exact[i].velocity_squared - sampling[i].velocity_squared).norm() < 2.5e-2);
  }
}

TEST_CASE("CellIntegrals: cells add up to N Dt, and to the integral of sum v_k^2") {
  const auto simulation = simulation_of(rough_mixture(20), 22);
  CellIntegrals<2> integrals(*simulation, {5, 3});
  Totals<2> totals(*simulation);
  EventTimes events;
  simulation->add_observer(integrals);
  simulation->add_observer(totals);
  simulation->add_observer(events);
  double begin = 0.0;
  for (const double end : {0.01, 60.0, 61.0, 300.0}) {
    simulation->run_until(end);
    const CellMoments<2> sum = total(integrals.close_window());
    const double disk_time = 20.0 * (end - begin);
    CHECK(sum.count == doctest::Approx(disk_time).epsilon(1e-10));
    const Vec2 expected = totals.close_window().temperature * disk_time;
    CHECK(sum.velocity_squared.isApprox(expected, 1e-10));
    begin = end;
  }
  CHECK(events.base_moves >= 2);
}

TEST_CASE("CellIntegrals: cells add up to the momentum, which a periodic box conserves") {
  Scene scene = gas(8.0, 9.0, 20, 0.9);
  State<2> start = start_state(scene, 23);
  for (Vec2& v : start.velocities) v += Vec2(0.5, -0.25);  // a flow: P = (10, -5)
  Simulation<2> simulation(model_of(scene, 23), start);
  CellIntegrals<2> integrals(simulation, {4, 6});
  simulation.add_observer(integrals);
  simulation.run_until(50.0);
  const CellMoments<2> sum = total(integrals.close_window());
  CHECK(sum.velocity.isApprox(50.0 * Vec2(10.0, -5.0), 1e-10));
}

TEST_CASE("CellIntegrals: windows add up whenever they are closed") {
  const auto simulation = simulation_of(rough_mixture(20), 24);
  CellIntegrals<2> whole(*simulation, {6, 5});
  CellIntegrals<2> often(*simulation, {6, 5});
  EventTimes events;
  simulation->add_observer(whole);
  simulation->add_observer(often);
  simulation->add_observer(events);
  Grid sum;
  for (int k = 1; k <= 500; ++k) {
    simulation->run_until(0.0008 * k * k);  // windows of 0.0008 to 0.8, to time 200
    add(sum, often.close_window());
  }
  add(sum, often.close_window());  // empty
  REQUIRE(events.base_moves >= 1);
  CHECK(difference(whole.close_window(), sum) < 1e-9);
}

TEST_CASE("CellIntegrals: watching from the middle of a run is as from a start there") {
  const auto simulation = simulation_of(rough_mixture(20), 25);
  CellIntegrals<2> early(*simulation, {6, 5});
  simulation->add_observer(early);
  simulation->run_until(5.123);
  early.close_window();
  CellIntegrals<2> late(*simulation, {6, 5});  // most disks are in the middle of a flight
  simulation->add_observer(late);
  simulation->run_until(9.0);
  CHECK(difference(early.close_window(), late.close_window()) < 1e-13);
}
