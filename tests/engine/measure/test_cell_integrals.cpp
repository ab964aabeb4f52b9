#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/totals.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/measure/sums.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// The integrals of one free particle on a grid.
Grid of_lone_particle(const Vec2& box, const IntVec<2>& cells, const Vec2& r, const Vec2& v,
                      double duration) {
  const auto simulation = lone_particle(gas(box.x(), box.y(), 1, 1.0), r, v);
  CellIntegrals<2> integrals(*simulation, cells, full_layout());
  simulation->add_observer(integrals);
  simulation->run_until(duration);
  return close(integrals);
}

void add(Grid& sum, const Grid& more) {
  if (sum.empty()) sum.resize(more.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

/// The same integrals from the states at the middle of many short steps.
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
      Sums& cell = grid[static_cast<std::size_t>(column + row * cells.x())];
      cell.count += step;
      cell.velocity += state.velocities[i] * step;
      const double w = state.spins.empty() ? 0.0 : state.spins[i][0];
      const double spin_energy = 0.125 * simulation.model().inertia * w * w;
      cell.spin += w * step;
      cell.spin_energy += spin_energy * step;
      cell.energy_flux +=
          (0.5 * state.velocities[i].squaredNorm() + spin_energy) * state.velocities[i] * step;
      cell.products += state.velocities[i] * state.velocities[i].transpose() * step;
    }
  }
  return grid;
}

}  // namespace

TEST_CASE("CellIntegrals: a flight is cut at every border, also if it starts or ends on one") {
  struct Case {
    Vec2 box;
    IntVec<2> cells;
    Vec2 r, v;
    double duration;
    std::vector<double> times;
  };
  const Case cases[] = {
      // Borders in x at t = .75, 1.75, in y at t = .5, 1.5: cells of unit side.
      {{3, 4},
       {3, 4},
       {0.25, 0.5},
       {1, 1},
       2.0,
       {0.5, 0, 0, 0.25, 0.75, 0, 0, 0.25, 0.25, 0, 0, 0}},
      // Back, and through the corners of cells.
      {{3, 4}, {3, 4}, {2.5, 2.5}, {-1, -1}, 2.25, {0.75, 0, 0, 0, 1, 0, 0, 0, 0.5, 0, 0, 0}},
      // At rest. A cell holds its lower border.
      {{4, 2}, {4, 2}, {2.5, 0.5}, {0, 0}, 7.0, {0, 0, 7, 0, 0, 0, 0, 0}},
      {{4, 2}, {4, 2}, {2, 1}, {0, 0}, 7.0, {0, 0, 0, 0, 0, 0, 7, 0}},
      // Along one axis, round the box, in a cell and on a border.
      {{2, 3}, {2, 3}, {0.5, 1.5}, {0, 2}, 2.0, {0.5, 0, 0.75, 0, 0.75, 0}},
      {{2, 3}, {2, 3}, {1, 1.5}, {0, 2}, 2.0, {0, 0.5, 0, 0.75, 0, 0.75}},
      // From a border. From the border of the box, it is followed by the far cells.
      {{4, 2}, {4, 1}, {2, 1}, {1, 0}, 0.5, {0, 0, 0.5, 0}},
      {{4, 2}, {4, 1}, {2, 1}, {-1, 0}, 0.5, {0, 0.5, 0, 0}},
      {{4, 2}, {4, 1}, {0, 1}, {-1, 0}, 0.5, {0, 0, 0, 0.5}},
      // To a border.
      {{4, 2}, {4, 1}, {0.5, 1}, {1, 0}, 1.5, {0.5, 1, 0, 0}},
  };
  for (const auto& [box, cells, r, v, duration, times] : cases) {
    CAPTURE(r);
    CAPTURE(v);
    const Grid grid = of_lone_particle(box, cells, r, v, duration);
    REQUIRE(grid.size() == times.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      CAPTURE(i);
      CHECK(std::fabs(grid[i].count - times[i]) < 1e-12);
      CHECK((grid[i].velocity - v * times[i]).norm() < 1e-12);
      CHECK((grid[i].squares() - v.cwiseAbs2() * times[i]).norm() < 1e-12);
    }
  }
}

TEST_CASE("CellIntegrals: a flight over many boxes visits all cells on its line equally") {
  // In 80 time units the particle crosses the box 20 times along x, and 10 times backwards along y.
  const Vec2 v = {1.0, -0.5};
  const Grid grid = of_lone_particle({4.0, 4.0}, {4, 4}, {0.5, 3.75}, v, 80.0);
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

TEST_CASE("CellIntegrals: cells whose sides are no binary fractions") {
  // 1/10 of 1.5: borders are not exact, and the particle must not be lost between two cells.
  const Vec2 v = {0.3, -0.7};
  const Grid grid = of_lone_particle({1.5, 2.1}, {10, 7}, {0.45, 0.3}, v, 1000.0);
  CHECK(total(grid).count == doctest::Approx(1000.0).epsilon(1e-12));
  CHECK(std::ranges::all_of(grid, [](const auto& cell) { return cell.count >= 0.0; }));
}

TEST_CASE("CellIntegrals: a gas agrees with sampling its states") {
  // With steps of 1e-4, each of some ten border crossings of a cell has an error of up to half a
  // step. This gives 1e-3 in time, more in v and v^2 (speeds up to 5), but less than one lost
  // crossing.
  constexpr double kDuration = 4.0;
  const IntVec<2> cells = {3, 4};
  Scene scene = gas(6.0, 5.0, 12, 0.8);
  wall_in(scene, 0, {.kind = WallKind::Driven, .drive_speed = 1.0});
  const auto watched = simulation_of<2>(scene, 21);
  CellIntegrals<2> integrals(*watched, cells, full_layout());
  watched->add_observer(integrals);
  watched->run_until(kDuration);
  const Grid exact = close(integrals);

  const auto sampled = simulation_of<2>(scene, 21);
  const Grid sampling = by_sampling(*sampled, cells, kDuration, 40000);
  REQUIRE(sampled->counts().wall_collisions >= 10);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(exact[i].count - sampling[i].count) < 1e-3);
    CHECK((exact[i].velocity - sampling[i].velocity).norm() < 5e-3);
    CHECK((exact[i].squares() - sampling[i].squares()).norm() < 2.5e-2);
  }
}

TEST_CASE("CellIntegrals: cells add up to N Dt, and to the integral of sum v_k^2") {
  const auto simulation = simulation_of<2>(rough_mixture(20), 22);
  CellIntegrals<2> integrals(*simulation, {5, 3}, full_layout());
  Totals<2> totals(*simulation);
  EventTimes events;
  simulation->add_observer(integrals);
  simulation->add_observer(totals);
  simulation->add_observer(events);
  double begin = 0.0;
  for (const double end : {0.01, 60.0, 61.0, 300.0}) {
    simulation->run_until(end);
    const Sums sum = total(close(integrals));
    const double particle_time = 20.0 * (end - begin);
    CHECK(sum.count == doctest::Approx(particle_time).epsilon(1e-10));
    const Vec2 expected = totals.close_window().temperature * particle_time;
    CHECK(sum.squares().isApprox(expected, 1e-10));
    begin = end;
  }
  CHECK(events.base_moves >= 2);
}

TEST_CASE("CellIntegrals: cells add up to the momentum, which a periodic box conserves") {
  Scene scene = gas(8.0, 9.0, 20, 0.9);
  State<2> start = start_state<2>(scene, 23);
  for (Vec2& v : start.velocities) v += Vec2(0.5, -0.25);  // a flow: P = (10, -5)
  Simulation<2> simulation(model_of<2>(scene, 23), start);
  CellIntegrals<2> integrals(simulation, {4, 6}, full_layout());
  simulation.add_observer(integrals);
  simulation.run_until(50.0);
  const Sums sum = total(close(integrals));
  CHECK(sum.velocity.isApprox(50.0 * Vec2(10.0, -5.0), 1e-10));
}

TEST_CASE("CellIntegrals: windows add up whenever they are closed") {
  const auto simulation = simulation_of<2>(rough_mixture(20), 24);
  CellIntegrals<2> whole(*simulation, {6, 5}, full_layout());
  CellIntegrals<2> often(*simulation, {6, 5}, full_layout());
  EventTimes events;
  simulation->add_observer(whole);
  simulation->add_observer(often);
  simulation->add_observer(events);
  Grid sum;
  for (int k = 1; k <= 500; ++k) {
    simulation->run_until(0.0008 * k * k);  // windows of 0.0008 to 0.8, to time 200
    add(sum, close(often));
  }
  add(sum, close(often));  // empty
  REQUIRE(events.base_moves >= 1);
  CHECK(difference(close(whole), sum) < 1e-9);
}

namespace {

/// Adds every collision point by point along its branch vector, at positions in the box.
class PointByPoint : public Observer<2> {
 public:
  PointByPoint(const Simulation<2>& simulation, const IntVec<2>& cells)
      : grid(static_cast<std::size_t>(cells.prod())),
        slack(grid.size()),
        simulation_(simulation),
        cells_(cells) {}

  Grid grid;
  std::vector<double> slack;  ///< of each cell: two points of every branch in it
  int through_borders = 0;    ///< branch vectors that leave the box

  void on_collision(const PairCollision<2>& c) override {
    // The touching image of the partner. Flights may have crossed the box several times.
    const Vec2 apart = c.particles[0].position - c.particles[1].position;
    const Vec2 near = c.particles[1].position +
                      apart.cwiseQuotient(box()).array().round().matrix().cwiseProduct(box());
    Vec2 touching;
    double best = 1.0;
    for (int i = -3; i <= 3; ++i) {
      for (int j = -3; j <= 3; ++j) {
        const Vec2 image = near + box().cwiseProduct(Vec2(i, j));
        const double gap = std::fabs((c.particles[0].position - image).norm() - 1.0);
        if (gap < best) touching = image;
        best = std::min(best, gap);
      }
    }
    const double gain_1 = energy_gain(c.particles[0]), gain_2 = energy_gain(c.particles[1]);
    transfer(touching, c.particles[0].position, c.particles[0].gain.momentum,
             0.5 * (gain_1 - gain_2));
    for (const Vec2& end : {touching, c.particles[0].position}) {
      grid[cell_of(end)].dissipation += 0.5 * (gain_1 + gain_2);
    }
    through_borders += !inside(touching) || !inside(c.particles[0].position);
  }

  void on_wall(const WallCollision<2>& c) override {
    const double inset = simulation_.wall(c.side).displacement;
    Vec2 contact = c.particle.position;
    contact[c.side / 2] = c.side % 2 ? box()[c.side / 2] - inset : inset;
    transfer(contact, c.particle.position, c.particle.gain.momentum, energy_gain(c.particle));
  }

 private:
  static constexpr int kPoints = 4000;

  const Vec2& box() const { return simulation_.model().box; }
  bool inside(const Vec2& r) const {
    return (r.array() >= 0.0).all() && (r.array() < box().array()).all();
  }

  double energy_gain(const ParticleChange<2>& particle) const {
    const double w = particle.spin[0], after = w + particle.gain.spin[0];
    return 0.5 * ((particle.velocity + particle.gain.momentum).squaredNorm() -
                  particle.velocity.squaredNorm()) +
           0.125 * simulation_.model().inertia * (after * after - w * w);
  }

  std::size_t cell_of(Vec2 r) const {
    std::size_t index = 0;
    for (const int axis : {1, 0}) {
      if (simulation_.model().periodic(axis))
        r[axis] -= box()[axis] * std::floor(r[axis] / box()[axis]);
      const double place = std::floor(r[axis] / box()[axis] * cells_[axis]);
      index = index * static_cast<std::size_t>(cells_[axis]) +
              static_cast<std::size_t>(std::clamp(place, 0.0, cells_[axis] - 1.0));
    }
    return index;
  }

  void transfer(const Vec2& partner, const Vec2& particle, const Vec2& momentum, double energy) {
    const Vec2 branch = particle - partner;
    std::size_t before = grid.size();
    for (int k = 0; k < kPoints; ++k) {
      const std::size_t index = cell_of(partner + branch * ((k + 0.5) / kPoints));
      if (index != before) slack[index] += 2.0 * (momentum.norm() + std::fabs(energy)) / kPoints;
      before = index;
      grid[index].transfer += branch * momentum.transpose() / kPoints;
      grid[index].energy_transfer += branch * energy / kPoints;
    }
  }

  const Simulation<2>& simulation_;
  IntVec<2> cells_;
};

/// Compares the collisional integrals of every cell with the points.
void check_collisions(const Scene& scene, const IntVec<2>& cells, std::uint64_t seed) {
  const auto simulation = simulation_of<2>(scene, seed);
  CellIntegrals<2> integrals(*simulation, cells, full_layout());
  PointByPoint points(*simulation, cells);
  simulation->add_observer(integrals);
  simulation->add_observer(points);
  simulation->run_until(6.0);
  const Grid grid = close(integrals);
  REQUIRE(simulation->counts().pair_collisions > 20);
  if (scene.periodic(0) || scene.periodic(1)) REQUIRE(points.through_borders > 5);
  double largest = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    CAPTURE(i);
    const Sums &cell = grid[i], &dense = points.grid[i];
    const double slack = 1e-12 + points.slack[i];
    CHECK((cell.transfer - dense.transfer).cwiseAbs().maxCoeff() < slack);
    CHECK((cell.energy_transfer - dense.energy_transfer).cwiseAbs().maxCoeff() < slack);
    CHECK(grid[i].dissipation == doctest::Approx(points.grid[i].dissipation).epsilon(1e-9));
    largest = std::max(largest, grid[i].transfer.cwiseAbs().maxCoeff());
  }
  CHECK(largest > 1.0);
}

Scene spinning(Scene scene) {
  scene.particles.roughness = {.friction = 0.5, .tangential_restitution = 0.3};
  scene.particles.start.spin_temperature = 1.0;
  return scene;
}

}  // namespace

TEST_CASE(
    "CellIntegrals: branch vectors are cut as points on them fall, through periodic borders") {
  check_collisions(gas(5.0, 4.0, 10, 0.8), {10, 6}, 51);
  check_collisions(spinning(gas(6.0, 4.0, 12, 0.8)), {3, 7}, 52);
  // With images nearer than the touching one.
  check_collisions(gas(12.0, 1.4, 7, 0.9), {12, 3}, 53);
}

TEST_CASE("CellIntegrals: branch vectors to walls, at rest and moving") {
  check_collisions(spinning(rough_mixture(20)), {9, 8}, 54);
  check_collisions(rough_mixture(20), {30, 25}, 55);
  Scene scene = gas(7.0, 6.0, 15, 0.9);
  wall_in(scene, 0, {.kind = WallKind::Sawtooth, .stroke = 0.8, .frequency = 1.3});
  wall_in(scene, 1, {.kind = WallKind::Sinusoidal, .stroke = 1.2, .frequency = 0.7});
  scene.walls[kTop]->roughness.friction = 0.5;
  check_collisions(scene, {14, 12}, 56);
}

TEST_CASE("CellIntegrals: falls of spinning particles are as dense sampling finds them") {
  constexpr double kDuration = 10.0;
  const IntVec<2> cells(4, 6);
  Scene scene = spinning(gas(6.0, 5.0, 8, 0.9));
  wall_in(scene, 1, {.kind = WallKind::Sinusoidal, .stroke = 0.4, .frequency = 1.1});
  scene.gravity = Vec2(0.4, -1.5);
  const auto watched = simulation_of<2>(scene, 57);
  CellIntegrals<2> integrals(*watched, cells, full_layout());
  watched->add_observer(integrals);
  watched->run_until(kDuration);
  const Grid exact = close(integrals);
  const auto sampled = simulation_of<2>(scene, 57);
  const Grid sampling = by_sampling(*sampled, cells, kDuration, 80000);
  REQUIRE(sampled->counts().wall_collisions >= 10);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(exact[i].count - sampling[i].count) < 2e-3);
    CHECK(std::fabs(exact[i].spin - sampling[i].spin) < 1e-2);
    CHECK(std::fabs(exact[i].spin_energy - sampling[i].spin_energy) < 1e-2);
    CHECK((exact[i].velocity - sampling[i].velocity).norm() < 1e-2);
    CHECK((exact[i].products - sampling[i].products).norm() < 3e-2);
    CHECK((exact[i].energy_flux - sampling[i].energy_flux).norm() < 1e-1);
  }
}

TEST_CASE("CellIntegrals: one fall by hand") {
  // From (1/2, 1) at velocity (1, 2) under (0, -1), three time units in one cell of a tall box:
  // v_y = 2 - t.
  Scene scene = gas(1000.0, 1000.0, 1, 1.0);
  scene.gravity = Vec2(0.0, -1.0);
  const auto simulation = lone_particle(scene, {0.5, 1.0}, {1.0, 2.0});
  CellIntegrals<2> integrals(*simulation, {1, 1}, full_layout());
  simulation->add_observer(integrals);
  simulation->run_until(3.0);
  const Sums sums = close(integrals)[0];
  CHECK(sums.count == 3.0);
  CHECK(sums.velocity.isApprox(Vec2(3.0, 1.5), 1e-14));
  CHECK(sums.products(0, 0) == doctest::Approx(3.0));
  CHECK(sums.products(0, 1) == doctest::Approx(1.5));
  CHECK(sums.products(1, 1) == doctest::Approx(3.0));  // (8 + 1)/3
  CHECK(sums.energy_flux.x() == doctest::Approx(0.5 * (3.0 + 3.0)));
  CHECK(sums.energy_flux.y() == doctest::Approx(0.5 * (1.5 + (16.0 - 1.0) / 4.0)));
}

TEST_CASE("CellIntegrals: snapshots count the particles where they are") {
  const IntVec<2> cells(5, 4);
  Scene scene = spinning(rough_mixture(20));
  scene.gravity = Vec2(0.0, -0.5);
  const auto simulation = simulation_of<2>(scene, 58);
  CellIntegrals<2> integrals(*simulation, cells, full_layout(), {Estimator::Snapshot, {}});
  simulation->add_observer(integrals);
  simulation->every(0.5, 1.0, [&](double) { integrals.sample(); });
  simulation->run_until(10.0);
  const CellSums sums = integrals.close_window();
  CHECK(sums.time == doctest::Approx(10.0));
  CHECK(sums.kinetic_weight == 10.0);
  Grid grid = grid_of(sums, integrals.layout());
  const auto again = simulation_of<2>(scene, 58);
  const Grid expected = by_sampling(*again, cells, 10.0, 10);
  CHECK(total(grid).transfer.cwiseAbs().maxCoeff() > 1.0);
  CHECK(total(grid).dissipation < 0.0);
  for (Sums& cell : grid) {
    cell.transfer.setZero();
    cell.energy_transfer.setZero();
    cell.dissipation = 0.0;
  }
  CHECK(difference(grid, expected) < 1e-12);
}

TEST_CASE("CellIntegrals: a Gaussian along the branch, at its ends, and at the particles") {
  // Head-on at t = 1/2, where the centres are at x = 2.5 and 3.5: 1 gains (-3/2, 0) and loses 3/8.
  Scene scene = gas(6.0, 5.0, 2, 0.5);
  Simulation<2> simulation(model_of<2>(scene, 1),
                           State<2>{{{2.0, 2.4}, {4.0, 2.4}}, {{1, 0}, {-1, 0}}});
  CellIntegrals<2> integrals(simulation, {6, 5}, full_layout(), {Estimator::Snapshot, 0.8});
  simulation.add_observer(integrals);
  simulation.run_until(0.25);
  integrals.sample();
  simulation.run_until(1.0);
  const Grid grid = close(integrals);
  REQUIRE(simulation.counts().pair_collisions == 1);
  const GaussianKernel<2> kernel(integrals.grid(), 0.8);
  Grid expected(grid.size());
  kernel.along({2.5, 2.4}, {1.0, 0.0},
               [&](std::size_t i, double weight) { expected[i].transfer(0, 0) += 1.5 * weight; });
  for (const double x : {2.5, 3.5}) {
    kernel.at({x, 2.4},
              [&](std::size_t i, double weight) { expected[i].dissipation -= 0.375 * weight; });
  }
  for (const double x : {2.25, 3.75}) {
    const double v = x < 3.0 ? 1.0 : -1.0;
    kernel.at({x, 2.4}, [&](std::size_t i, double weight) {
      expected[i].count += weight;
      expected[i].velocity.x() += weight * v;
      expected[i].products(0, 0) += weight;
      expected[i].energy_flux.x() += 0.5 * weight * v;
    });
  }
  CHECK(difference(grid, expected) < 1e-12);
}
