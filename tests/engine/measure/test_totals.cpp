#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/measure/totals.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

struct TimedRun {
  std::vector<WindowTotals<2>> windows;
  EventTimes events;
};

/// Runs to each of the ends and closes a window there.
TimedRun run_in_windows(const Scene& scene, std::uint64_t seed, const std::vector<double>& ends,
                        bool mixes) {
  TimedRun run;
  const auto simulation = run_of(scene, seed, mixes);
  Totals<2> totals(*simulation);
  simulation->add_observer(totals);
  simulation->add_observer(run.events);
  for (const double end : ends) {
    simulation->run_until(end);
    run.windows.push_back(totals.close_window());
  }
  return run;
}

/// Integral of sum m v_k^2 from `begin` to `end`, from the states of a second run without
/// observers, half-way between successive events.
Vec2 brute_force_integral(Simulation<2>& simulation, const std::vector<double>& events,
                          double begin, double end) {
  Vec2 integral = Vec2::Zero();
  double time = begin;
  const auto add_until = [&](double until) {
    simulation.run_until(0.5 * (time + until));
    integral += squares(simulation) * (until - time);
    time = until;
  };
  for (const double event : events) {
    if (event > begin && event < end) add_until(event);
  }
  add_until(end);
  return integral;
}

}  // namespace

TEST_CASE("Totals: the temperature is the exact time average, across base moves") {
  const Scene scene = rough_mixture(20);
  const std::vector<double> ends = {0.3, 40.0, 40.0001, 300.0};
  for (const bool mixes : {false, true}) {
    CAPTURE(mixes);
    const TimedRun run = run_in_windows(scene, 7, ends, mixes);
    REQUIRE(run.events.base_moves >= 2);  // the first comes after 1024 events

    const auto again = run_of(scene, 7, mixes);
    double begin = 0.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const Vec2 integral = brute_force_integral(*again, run.events.times, begin, ends[k]);
      const Vec2 expected = integral / (20.0 * (ends[k] - begin));
      CAPTURE(k);
      // Durations and event times have the rounding errors of times about 300.
      CHECK(run.windows[k].duration == doctest::Approx(ends[k] - begin).epsilon(1e-9));
      CHECK(run.windows[k].temperature.x() == doctest::Approx(expected.x()).epsilon(1e-9));
      CHECK(run.windows[k].temperature.y() == doctest::Approx(expected.y()).epsilon(1e-9));
      begin = ends[k];
    }
  }
}

// The change of the energy of a run must equal the sums of its windows.
static void check_windows(bool mixes) {
  CAPTURE(mixes);
  const auto simulation = run_of(rough_mixture(30), 8, mixes);
  Totals<2> totals(*simulation);
  simulation->add_observer(totals);
  double energy = simulation->kinetic_energy();
  std::uint64_t collisions = 0;
  for (int k = 1; k <= 20; ++k) {
    simulation->run_until(5.0 * k);
    const WindowTotals<2> window = totals.close_window();
    const double gained = simulation->kinetic_energy() - energy;
    const double turnover = std::fabs(window.walls_in) + window.dissipated + energy;
    CHECK(std::fabs(window.walls_in - window.dissipated - gained) < 1e-12 * turnover);
    CHECK(window.dissipated > 0.0);
    CHECK(window.collisions ==
          static_cast<double>(simulation->counts().pair_collisions - collisions));
    energy += gained;
    collisions = simulation->counts().pair_collisions;
    CHECK(totals.ledger_residual() < 1e-13);
  }
}

TEST_CASE("Totals: the sum of every window equals the change of the energy") {
  check_windows(false);
  check_windows(true);
}

TEST_CASE("Totals: the ledger of a gas that cools to nothing stays closed") {
  const auto simulation = simulation_of<2>(gas(10.0, 10.0, 20, 0.7), 9);
  Totals<2> totals(*simulation);
  simulation->add_observer(totals);
  simulation->run_until(1e4, 3000);
  REQUIRE(simulation->kinetic_energy() < 1e-3);
  CHECK(totals.ledger_residual() < 1e-13);
}

TEST_CASE("Totals: the ledger shows missing events") {
  // An observer that misses some events cannot close the balance.
  const auto simulation = simulation_of<2>(gas(10.0, 10.0, 20, 0.7), 9);
  Totals<2> totals(*simulation);
  simulation->run_until(1e4, 10);
  CHECK(totals.ledger_residual() > 1e-3);
}

// The moments at the end of a window must equal those of the state, whose flow is removed here.
static void check_moments(const WindowTotals<2>& window, const Simulation<2>& simulation) {
  const double shear_rate = simulation.model().shear_rate.value_or(0.0);
  const State<2> state = simulation.state();
  Vec2 second = Vec2::Zero(), fourth = Vec2::Zero();
  const auto count = static_cast<double>(state.positions.size());
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    Vec2 v = state.velocities[i];
    v.x() -= shear_rate * (state.positions[i].y() - 0.5 * simulation.model().box.y());
    const Vec2 square = simulation.grain(i).mass * v.cwiseAbs2();
    second += square / count;
    fourth += square.cwiseAbs2() / count;
  }
  for (const int k : {0, 1}) {
    CHECK(window.second_moment[k] == doctest::Approx(second[k]).epsilon(1e-11));
    CHECK(window.fourth_moment[k] == doctest::Approx(fourth[k]).epsilon(1e-11));
  }
}

// Windows of different lengths, most of them with fewer events than particles.
static void check_moments(Simulation<2>& simulation) {
  Totals<2> totals(simulation);
  const Observation<2> observation(simulation, totals);
  std::vector<double> ends = {0.02, 0.05, 0.1, 0.5, 2.0, 30.0};
  for (int k = 0; k < 400; ++k) ends.push_back(ends.back() + 0.05);  // the base moves meanwhile
  for (const double end : ends) {
    CAPTURE(end);
    simulation.run_until(end);
    check_moments(totals.close_window(), simulation);
  }
}

TEST_CASE("Totals: the moments of velocity at the ends of windows are those of the state") {
  for (const bool mixes : {false, true}) {
    CAPTURE(mixes);
    check_moments(*run_of(rough_mixture(30), 8, mixes));
    check_moments(*run_of(everything_in_motion(30), 8, mixes));
  }
  const Model<2> model = sheared(inelastic(periodic_box(9.0, 8.0), 0.8), -1.3);
  Simulation<2> simulation(model, gas_in_flow<2>(model, 30));
  check_moments(simulation);
}

TEST_CASE("Totals: the moments of velocity are those of the state after a change of gravity") {
  Simulation<2> simulation(falling(periodic_box(9.0, 8.0), {0.0, -0.5}),
                           clear_gas(periodic_box(9.0, 8.0), 30, 81));
  Totals<2> totals(simulation);
  const Observation<2> observation(simulation, totals);
  simulation.run_until(1.0);
  Model<2> model = simulation.model();
  model.gravity.y() = 2.0;
  simulation.set_laws(model);
  const std::uint64_t before = simulation.counts().pair_collisions;
  simulation.run_until(1.1);
  const std::uint64_t since = simulation.counts().pair_collisions - before;
  CHECK(since > 0);
  CHECK(since < 15);  // fewer changes than particles
  check_moments(totals.close_window(), simulation);
}

// One particle falls from time 0, another one from time 1. Between 1 and 2 the mean of v^2 is
// g^2 (7/3 + 1/3)/2.
TEST_CASE("Totals: particles that enter fall from then on") {
  Simulation<2> simulation(falling(periodic_box(10.0, 10.0), {0.0, -0.5}),
                           State<2>{{{2.0, 5.0}}, {{0.0, 0.0}}});
  Totals<2> totals(simulation);
  simulation.add_observer(totals);
  simulation.run_until(1.0);
  totals.close_window();
  simulation.add_particles({{7.0, 5.0}});
  simulation.run_until(2.0);
  const WindowTotals<2> window = totals.close_window();
  CHECK(window.temperature.y() == doctest::Approx(0.25 * 4.0 / 3.0).epsilon(1e-12));
  CHECK(window.fourth_moment.y() == doctest::Approx((1.0 + 0.0625) / 2.0).epsilon(1e-12));
}

TEST_CASE("Totals: the momentum of the walls equals the loss of the gas") {
  // Static and driven walls act along their normals only.
  Scene scene = rough_mixture(25);
  scene.walls[kBottom] = Wall{.kind = WallKind::Static, .restitution = 0.95};
  scene.walls[kTop] = Wall{.kind = WallKind::Driven, .restitution = 0.8, .drive_speed = 0.7};
  const auto simulation = simulation_of<2>(scene, 10);
  Totals<2> totals(*simulation);
  simulation->add_observer(totals);
  Vec2 before = momentum(*simulation);
  for (int k = 1; k <= 10; ++k) {
    simulation->run_until(10.0 * k);
    const auto impulse = totals.close_window().wall_impulse;
    const Vec2 gained = momentum(*simulation) - before;
    const double turnover = impulse[0] + impulse[1] + impulse[2] + impulse[3];
    CHECK(std::fabs(impulse[kLeft] - impulse[kRight] - gained.x()) < 1e-12 * turnover);
    CHECK(std::fabs(impulse[kBottom] - impulse[kTop] - gained.y()) < 1e-12 * turnover);
    before += gained;
  }
}

TEST_CASE("Totals: a head-on collision by hand") {
  // g_n = -2, alpha = 1/2: each changes by (1 + alpha)/2 * 2 = 1.5 (theory 3.2); the energy lost is
  // (1 - alpha^2) g_n^2 / 4 = 0.75 (theory 3.6); impulse and separation are parallel, one diameter.
  const Scene scene = gas(20.0, 20.0, 2, 0.5);
  const State<2> start{{{5.0, 5.0}, {8.0, 5.0}}, {{1.0, 0.0}, {-1.0, 0.0}}};
  Simulation<2> simulation(model_of<2>(scene, 1), start);
  Totals<2> totals(simulation);
  simulation.add_observer(totals);
  simulation.run_until(2.0);  // they meet at time 1
  const WindowTotals<2> window = totals.close_window();
  CHECK(window.collisions == 1.0);
  CHECK(window.virial == doctest::Approx(1.5));
  CHECK(window.dissipated == doctest::Approx(0.75));
  CHECK(window.walls_in == 0.0);
  CHECK(window.temperature.x() == doctest::Approx(0.5 * (1.0 + 0.25)));  // 1 for half the time
  CHECK(window.temperature.y() == 0.0);
  CHECK(window.second_moment.x() == doctest::Approx(0.25));
  CHECK(window.fourth_moment.x() == doctest::Approx(0.0625));
}
