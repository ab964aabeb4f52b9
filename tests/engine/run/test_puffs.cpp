// Puffs: particles that enter the gas by [[change]].

#include <doctest/doctest.h>

#include <cmath>

#include "engine/error.h"
#include "tests/engine/run/acts.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kPuffSeed = 31;

// A dilute periodic gas, just before and after a puff of 900 particles at t = 1.
template <int D>
struct Puffs {
  static constexpr double kBox = D == 2 ? 400.0 : 90.0, kRadius = D == 2 ? 150.0 : 40.0;
  State<D> before, after;

  Puffs() {
    const std::string gas = std::string("particles.count = 20\nbox.size = ") +
                            (D == 2 ? "[400, 400]" : "[90, 90, 90]") + "\n";
    const std::string puff = D == 2 ? "centre = [5, 45], radius = 150, velocity = [-2, 0.5]"
                                    : "centre = [5, 45, 45], radius = 40, velocity = [-2, 0.5, 4]";
    ScheduledRun<D> plain(parse_scene(gas, ""), kPuffSeed);
    ScheduledRun<D> run(parse_scene(gas +
                                        "[[change]]\ntime = 1\npuff = { count = 900, temperature "
                                        "= 3, " +
                                        puff + " }\n",
                                    ""),
                        kPuffSeed);
    plain.run_until(1.0);
    run.run_until(1.0);
    before = plain.simulation().state();
    after = run.simulation().state();
  }
};

// Of 900 particles, with relative standard errors of 2 to 3 %. The widths are 5 standard errors.
template <int D>
void check_places_and_velocities() {
  const Puffs<D> puff;
  REQUIRE(puff.after.positions.size() == 920);
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(puff.after.positions[i] == puff.before.positions[i]);
    CHECK(puff.after.velocities[i] == puff.before.velocities[i]);
  }
  Vec<D> centre = Vec<D>::Constant(45.0), drift = Vec<D>::Constant(4.0);
  centre[0] = 5.0;
  drift[0] = -2.0;
  drift[1] = 0.5;
  double share = 0.0, squares = 0.0;
  Vec<D> sum = Vec<D>::Zero(), side = Vec<D>::Zero();
  for (std::size_t i = 20; i < 920; ++i) {
    Vec<D> way = puff.after.positions[i] - centre;
    for (double& x : way) x -= Puffs<D>::kBox * std::round(x / Puffs<D>::kBox);
    CHECK(way.norm() <= Puffs<D>::kRadius * (1.0 + 1e-12));
    share += std::pow(way.norm() / Puffs<D>::kRadius, D) / 900.0;
    side += way / (Puffs<D>::kRadius * 900.0);
    sum += (puff.after.velocities[i] - drift) / 900.0;
    squares += (puff.after.velocities[i] - drift).squaredNorm() / (900.0 * D * 3.0);
  }
  CHECK(std::fabs(share - 0.5) < 5.0 * std::sqrt(1.0 / 12.0 / 900.0));
  CHECK(std::fabs(squares - 1.0) < 5.0 * std::sqrt(2.0 / (900.0 * D)));
  for (int axis = 0; axis < D; ++axis) {
    CHECK(std::fabs(sum[axis]) < 5.0 * std::sqrt(3.0 / 900.0));
    CHECK(std::fabs(side[axis]) < 5.0 * std::sqrt(1.0 / (D + 2) / 900.0));
  }
}

}  // namespace

TEST_CASE("Puff: places are uniform in the region, velocities Gaussian, and other particles stay") {
  SUBCASE("disks") {
    check_places_and_velocities<2>();
  }
  SUBCASE("spheres") {
    check_places_and_velocities<3>();
  }
}

TEST_CASE("Puff: two puffs of a run have different places and velocities") {
  const auto puff = [](const char* x) {
    return std::string("[[change]]\ntime = 1\npuff = { count = 3, centre = [") + x +
           ", 20], radius = 20 }\n";
  };
  ScheduledRun<2> run(
      parse_scene("box.size = [80, 40]\nparticles.count = 0\n" + puff("20") + puff("60"), ""),
      kPuffSeed);
  run.run_until(1.0);
  const State<2> state = run.simulation().state();
  REQUIRE(state.positions.size() == 6);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK((state.positions[i + 3] - state.positions[i] - Vec2(40.0, 0.0)).norm() > 1e-3);
    CHECK(state.velocities[i + 3] != state.velocities[i]);
  }
}

TEST_CASE("Puff: no particle overlaps another, a moving wall or the piston") {
  ScheduledRun<2> run(puffed(), kPuffSeed);
  for (const double time : {2.0, 3.3, 9.0}) {
    run.run_until(time);
    CHECK(run.simulation().deepest_overlap() < 1e-12);
    CHECK(run.simulation().checks().deepest_overlap < 1e-12);
  }
  CHECK(run.simulation().particles().size() == 44);
  CHECK(run.laws().particles.count == 30);
  CHECK(run.present_scene().particles.count == 44);

  // The wall moves by 1.25 to either side of y = 0. A disk there would be hit.
  const Scene above = parse_scene(
      "box.size = [40, 10]\nparticles.count = 1\nwalls.top = { kind = 'static' }\n"
      "walls.bottom = { kind = 'sinusoidal', stroke = 2.5, frequency = 0.1 }\n"
      "[[change]]\ntime = 0.1\n"
      "puff = { count = 15, centre = [20, 0], radius = 5, temperature = 0 }\n",
      "");
  ScheduledRun<2> waiting(above, kPuffSeed);
  waiting.run_until(0.1);
  for (const Vec2& place : waiting.simulation().positions()) CHECK(place.y() >= 1.75);
}

TEST_CASE("Puff: its energy has its own sum, and the ledger stays closed") {
  const auto run = watched_run(puffed(), kPuffSeed);
  run->run_until(std::nextafter(2.0, 0.0), kNoLimit, kNoLimit);
  const double before = filled_frame(*run).tally.nudges_in;
  run->run_until(2.0, kNoLimit, kNoLimit);
  const Frame after = filled_frame(*run);
  double energy = 0.0;
  const State<2> state = std::get<State<2>>(run->state());
  for (std::size_t i = 30; i < 39; ++i) energy += 0.5 * state.velocities[i].squaredNorm();
  CHECK(before == 0.0);
  CHECK(energy > 5.0);
  CHECK(after.tally.nudges_in == doctest::Approx(energy).epsilon(1e-12));
  run->run_until(6.0, kNoLimit, kNoLimit);
  CHECK(filled_frame(*run).ledger_residual < 1e-12);
}

TEST_CASE("Puff: trails and rotations of the new particles begin at it") {
  Scene scene = puffed();
  scene.view.trails = 0.5;
  ScheduledRun<2> run(scene, kPuffSeed);
  run.show(scene.view);
  run.run_until(2.1);
  const Snapshot gas = run.snapshot();
  CHECK(gas.angles.size() == 39);
  double earliest_old = 0.0, earliest_new = 0.0;
  for (const FlightPiece& piece : gas.flights) {
    double& earliest = piece.particle < 30 ? earliest_old : earliest_new;
    earliest = std::min(earliest, piece.from);
  }
  CHECK(earliest_old == doctest::Approx(-0.5));
  CHECK(earliest_new == doctest::Approx(-0.1));
}

TEST_CASE("Puff: without room, or too fast, it stops the run, and the state remains") {
  const std::string gas = "box.size = [12, 10]\nparticles.count = 40\n[[change]]\ntime = 1\n";
  ScheduledRun<2> full(
      parse_scene(gas + "puff = { count = 80, centre = [3, 3], radius = 3 }\n", ""), kPuffSeed);
  CHECK_THROWS_AS(full.run_until(2.0), PhysicalStop);
  CHECK(full.simulation().particles().size() == 40);
  CHECK(full.simulation().counts().puffs == 0);
  CHECK(full.simulation().time() == 1.0);

  ScheduledRun<2> fast(
      parse_scene(
          gas + "puff = { count = 2, centre = [3, 3], radius = 4, velocity = [1e15, 1e15] }\n", ""),
      kPuffSeed);
  CHECK_THROWS_WITH_AS(fast.run_until(2.0),
                       "a puff gives particle 40 a speed above 1e+15; make it colder",
                       PhysicalStop);
}

TEST_CASE("Puff: by hand as many particles enter as find room, and impossible ones are refused") {
  const auto run = watched_run(parse_scene(kDrivenDisks, ""), kActSeed);
  run->run_until(1.7, kNoLimit, kNoLimit);
  const auto add = [&](int count, const Vec2& centre, double radius) {
    run->puff({.count = count, .centre = centre, .radius = radius}, 0.0);
  };
  CHECK_THROWS_AS(add(1, {13.0, 5.0}, 2.0), UserError);
  CHECK(filled_frame(*run).scene->changes.empty());
  add(200, {6.0, 5.0}, 4.0);
  const std::size_t full = std::get<State<2>>(run->state()).positions.size();
  CHECK(full > 41);
  CHECK(full < 110);
  const Frame frame = filled_frame(*run);
  CHECK(frame.scene->changes.at(0).puff->count == static_cast<int>(full) - 40);
  CHECK(hash_of_run(saved_scene(frame), run->time()) == *frame.state_hash);
  CHECK_THROWS_AS(add(200, {6.0, 5.0}, 1.0), UserError);
  // A nudge of a new particle would come before it.
  run->nudge({.particle = 40, .add = Vec2(0.0, 2.0)}, 0.0);
  CHECK_THROWS_AS(run->move_change(0, 5.0), UserError);
}
