#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

template <int D>
void check_elastic(const Model<D>& box, int count) {
  double deepest = 0.0;
  for (const Model<D>& model : {box, with_walls(box, 0, kStatic)}) {
    const State<D> start = random_gas(model, count, 925);
    Simulation<D> early(model, start);
    early.run_until(kNever, 100000);
    for (const double late : {1e6 + 0.1, 1e9 + 0.1, 1e12 + 0.1}) {
      Simulation<D> simulation(model, start, late);
      simulation.run_until(kNever, 100000);
      CHECK(simulation.state_hash() == early.state_hash());
      CHECK(simulation.checks().deepest_overlap == early.checks().deepest_overlap);
      deepest = std::max(deepest, brute_force_overlap(model, simulation.state()));
      check_sound(simulation);
    }
  }
  MESSAGE("deepest overlap ", brief(deepest));
  CHECK(deepest < 1e-12);
}

template <int D>
void check_moving_walls(const Model<D>& box, const Vec<D>& gravity) {
  double deepest = 0.0;
  for (const Wall& wall : {kSawtooth, kSinusoidal}) {
    for (const double frequency : {0.5, 2.0, 0.7}) {
      CAPTURE(frequency);
      Wall moving = wall;
      moving.frequency = frequency;
      const Model<D> model = falling<D>(inelastic(walled(box, moving), 0.9), gravity);
      const State<D> start = clear_gas(model, 20, 904);
      Simulation<D> early(model, start), late(model, start, 1e9);
      early.run_until(kNever, 3000);
      late.run_until(kNever, 3000);
      // .7 is rounded to a double. 1e9 times this double is not a whole number of periods.
      if (frequency != 0.7) CHECK(late.state_hash() == early.state_hash());
      deepest = std::max(deepest, late.checks().deepest_overlap);
      CHECK(late.deepest_overlap() <= 1e-12);
      check_sound(late);
    }
  }
  MESSAGE("deepest overlap ", brief(deepest));
  CHECK(deepest <= 1e-12);
}

template <int D>
void check_everything() {
  const Model<D> model = everything<D>();
  const State<D> start = clear_gas(model, 20, 905);
  Simulation<D> early(model, start), late(model, start, 1e12);
  early.run_until(kNever, 3000);
  late.run_until(kNever, 3000);
  CHECK(late.counts().kicks == early.counts().kicks);
  CHECK(late.counts().kicks > 10);
  CHECK(late.state_hash() == early.state_hash());
  CHECK(late.time() - 1e12 == doctest::Approx(early.time()).epsilon(1e-3));
  MESSAGE(late.counts().collisions(), " collisions and ", late.counts().kicks,
          " kicks, the same bits");
  check_sound(late);
}

}  // namespace

TEST_CASE(
    "Late times: an elastic gas from t = 1e6, 1e9 and 1e12" *
    doctest::description("the same bits as from t = 0, so the same gaps; overlap below 1e-12")) {
  check_elastic<2>(periodic_box(14.0, 13.0), 100);
}

TEST_CASE(
    "Late times: elastic spheres from t = 1e6, 1e9 and 1e12" *
    doctest::description("the same bits as from t = 0, so the same gaps; overlap below 1e-12")) {
  check_elastic<3>(periodic_box(6.0, 6.5, 5.5), 100);
}

TEST_CASE("Late times: moving walls at t = 1e9" *
          doctest::description("the same wall positions as at t = 0; overlap below 1e-12")) {
  check_moving_walls<2>(periodic_box(10.0, 9.0), {0.0, -0.5});
  check_moving_walls<3>(periodic_box(5.0, 4.5, 5.5), {0.0, -0.5, 0.2});
}

TEST_CASE("Late times: all features together from t = 1e12" *
          doctest::description("the same bits and kicks as from t = 0")) {
  check_everything<2>();
  check_everything<3>();
}
