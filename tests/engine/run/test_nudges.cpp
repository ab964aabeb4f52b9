// Nudges: changes of velocities by [[change]].

#include <doctest/doctest.h>

#include <cmath>

#include "engine/error.h"
#include "engine/measure/balance.h"
#include "engine/measure/totals.h"
#include "tests/engine/run/acts.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// A gas whose particles fly freely until the nudge at t = 1.
template <int D>
State<D> velocities_after(const std::string& nudge, State<D>& before) {
  const std::string box = D == 2 ? "[20, 20]" : "[20, 20, 20]";
  const std::string gas = "box.size = " + box + "\nparticles.count = 30\n";
  ScheduledRun<D> plain(parse_scene(gas, ""), kActSeed);
  ScheduledRun<D> run(parse_scene(gas + "[[change]]\ntime = 1\nnudge = " + nudge + "\n", ""),
                      kActSeed);
  plain.run_until(1.0);
  run.run_until(1.0);
  before = plain.simulation().state();
  return run.simulation().state();
}

// Distance to a point in a periodic box of 20.
template <int D>
double distance(const Vec<D>& position, const Vec<D>& centre) {
  double square = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    double way = std::fabs(position[axis] - centre[axis]);
    way = std::min(way, 20.0 - way);
    square += way * way;
  }
  return std::sqrt(square);
}

template <int D>
void check_scaling(const std::string& centre, const Vec<D>& place) {
  State<D> before;
  const State<D> after =
      velocities_after<D>("{ centre = " + centre + ", radius = 7.0, scale = 1.5 }", before);
  Vec<D> mean = Vec<D>::Zero();
  int inside = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    if (distance<D>(before.positions[i], place) > 7.0) continue;
    mean += before.velocities[i];
    ++inside;
  }
  REQUIRE(inside > 1);
  REQUIRE(inside < 30);
  mean /= inside;
  for (std::size_t i = 0; i < 30; ++i) {
    const bool changes = distance<D>(before.positions[i], place) <= 7.0;
    const Vec<D> expected =
        changes ? Vec<D>(mean + 1.5 * (before.velocities[i] - mean)) : before.velocities[i];
    CHECK((after.velocities[i] - expected).norm() < 1e-12);
    CHECK((after.positions[i] - before.positions[i]).norm() < 1e-12);
  }
}

}  // namespace

TEST_CASE("Nudge: scale heats a region about its mean velocity, across periodic sides") {
  SUBCASE("disks") {
    check_scaling<2>("[19.0, 1.0]", Vec2(19.0, 1.0));
  }
  SUBCASE("spheres") {
    check_scaling<3>("[19.0, 1.0, 10.0]", Vec<3>(19.0, 1.0, 10.0));
  }
}

TEST_CASE("Nudge: add and set give their velocities to a particle or a region, and no other") {
  struct Given {
    std::string place;
    Vec2 centre;
    double radius;
  };
  const Vec2 speed(0.5, -2.0);
  for (const Given& given : {Given{"centre = [10, 10], radius = 100", Vec2(10.0, 10.0), 100.0},
                             Given{"centre = [19, 4], radius = 6", Vec2(19.0, 4.0), 6.0},
                             Given{"particle = 17", {}, 0.0}}) {
    CAPTURE(given.place);
    State<2> before;
    const auto after = [&](const std::string& key) {
      return velocities_after<2>("{ " + given.place + ", " + key + " = [0.5, -2.0] }", before);
    };
    const State<2> added = after("add"), set = after("set");
    std::size_t inside = 0;
    for (std::size_t i = 0; i < 30; ++i) {
      const bool changes = given.radius > 0.0
                               ? distance<2>(before.positions[i], given.centre) <= given.radius
                               : i == 17;
      inside += changes;
      const Vec2 gained = added.velocities[i] - before.velocities[i];
      CHECK((gained - (changes ? speed : Vec2(0.0, 0.0))).norm() < 1e-12);
      CHECK(set.velocities[i] == (changes ? speed : before.velocities[i]));
    }
    CHECK(inside > 0);
    CHECK((inside < 30) == (given.radius < 100.0));
  }
}

TEST_CASE("Nudge: the ledger and all balances stay closed, and its energy has its own sum") {
  const Scene scene = nudged();
  ScheduledRun<2> run(scene, kActSeed);
  run.run_until(2.5);
  Totals<2> totals(run.simulation());
  Balance<2> balance(run.simulation(), IntVec<2>(4, 3));
  run.simulation().add_observer(totals);
  run.simulation().add_observer(balance);
  run.run_until(std::nextafter(3.3, 0.0));
  const double energy = run.simulation().kinetic_energy();
  run.run_until(3.3);
  const double gained = run.simulation().kinetic_energy() - energy;
  REQUIRE(std::fabs(gained) > 1.0);
  run.run_until(5.0);
  CHECK(totals.close_window().nudges_in == doctest::Approx(gained).epsilon(1e-9));
  CHECK(totals.ledger_residual() < 1e-12);
  CHECK(balance.close_window().imbalances.largest().maxCoeff() < 1e-9);
}

TEST_CASE("Nudge: a velocity beyond the largest stops the run, and the state remains") {
  std::string text = kDrivenDisks;
  for (int i = 0; i < 8; ++i) {
    text += "[[change]]\ntime = 1\nnudge = { centre = [6, 5], radius = 9, scale = 1000 }\n";
  }
  ScheduledRun<2> run(parse_scene(text, ""), kActSeed);
  CHECK_THROWS_AS(run.run_until(2.0), PhysicalStop);
  CHECK(run.simulation().counts().nudges < 8);
  CHECK(std::isfinite(run.simulation().kinetic_energy()));

  // A speed that rounds to the largest.
  ScheduledRun<2> thrown(
      parse_scene(
          kDrivenDisks + "[[change]]\ntime = 1\nnudge = { particle = 3, set = [1e15, 1e9] }\n", ""),
      kActSeed);
  CHECK_THROWS_WITH_AS(thrown.run_until(2.0),
                       "a nudge gives particle 3 a speed above 1e+15; make it weaker",
                       PhysicalStop);
}

// A gas without losses between driven walls stops at a million times its fastest speed.
TEST_CASE("Nudge: a particle may be thrown faster than walls could drive it") {
  const Scene scene = parse_scene(
      "box.size = [12, 10]\nparticles.count = 20\n"
      "walls.left = { kind = 'driven', drive_speed = 1.0 }\nwalls.right = { kind = 'static' }\n"
      "[[change]]\ntime = 1.0\nnudge = { particle = 3, set = [-1e8, 0.0] }\n",
      "");
  ScheduledRun<2> run(scene, kActSeed);
  run.run_until(1.0);
  ScheduledRun<2> resumed(scene, kActSeed, run.simulation().save());
  for (ScheduledRun<2>* thrown : {&run, &resumed}) {
    const std::uint64_t before = thrown->simulation().counts().wall_collisions;
    CHECK_NOTHROW(thrown->run_until(1.0 + 1e-6));
    CHECK(thrown->simulation().counts().wall_collisions > before);
  }
}

TEST_CASE("Nudge: by hand an impossible one is refused, and the future stays") {
  const auto run = watched_run(parse_scene(kDrivenDisks, ""), kActSeed);
  run->run_until(4.0, kNoLimit, kNoLimit);
  run->go_back(2.0);
  run->run_until(2.0, kNoLimit, kNoLimit);
  CHECK_THROWS_AS(run->nudge({.particle = 40, .set = Vec2(1.0, 0.0)}, 0.0), UserError);
  CHECK_THROWS_AS(run->nudge({.particle = 4, .set = Vec2(1e16, 0.0)}, 0.0), PhysicalStop);
  const Frame frame = filled_frame(*run);
  CHECK(frame.head == doctest::Approx(4.0));
  CHECK(frame.scene->changes.empty());
  CHECK_FALSE(frame.other_future);
}

TEST_CASE("Nudge: removed from a run it leaves the bits of the others, and its future remains") {
  const Scene scene = parse_scene(kDrivenDisks, "");
  const auto run = watched_run(scene, kActSeed);
  const auto run_to = [&](double time) {
    run->run_until(time, kNoLimit, kNoLimit);
    return *filled_frame(*run).state_hash;
  };
  const auto fresh = [&](const std::vector<Change>& changes, double time) {
    Scene with = scene;
    with.changes = changes;
    return hash_of_run(with, time);
  };
  // Three equal nudges, two of them at one time.
  const Nudge heat{.centre = Vec2(6.0, 5.0), .radius = 3.0, .scale = 1.5};
  run->run_until(1.0, kNoLimit, kNoLimit);
  run->nudge(heat, 0.0);
  run->run_until(2.0, kNoLimit, kNoLimit);
  run->nudge(heat, 0.0);
  run->nudge(heat, 0.0);
  run->run_until(5.0, kNoLimit, kNoLimit);
  const std::vector<Change> three = filled_frame(*run).scene->changes;
  REQUIRE(three.size() == 3);
  const std::vector<Change> two(three.begin(), three.end() - 1);
  const double from = run->replace_changes(two, three.back().time);
  CHECK(from == three.back().time);
  run_to(from);
  CHECK(run->head() == doctest::Approx(2.0));
  CHECK(filled_frame(*run).scene->changes == two);
  CHECK(run_to(6.0) == fresh(two, 6.0));
  REQUIRE(filled_frame(*run).other_future);
  run_to(run->exchange_futures());
  CHECK(filled_frame(*run).scene->changes == three);
  CHECK(run_to(6.0) == fresh(three, 6.0));
  CHECK_THROWS_AS(run->replace_changes({}, 0.0), UserError);
  CHECK(run_to(7.0) == fresh(three, 7.0));
}
