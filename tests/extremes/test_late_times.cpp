#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("Late times: an elastic gas from t = 1e6, 1e9 and 1e12" *
          doctest::description("the same bits as from 0, so gaps as at 0; overlap below 1e-12")) {
  const Model<2> models[] = {periodic_box(14.0, 13.0),
                             with_walls(periodic_box(14.0, 13.0), 0, kStatic)};
  double deepest = 0.0;
  for (const Model<2>& model : models) {
    const State<2> start = random_gas(model, 100, 925);
    Simulation<2> early(model, start);
    early.run_until(kNever, 100000);
    for (const double late : {1e6 + 0.1, 1e9 + 0.1, 1e12 + 0.1}) {
      Simulation<2> simulation(model, start, late);
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

TEST_CASE("Late times: moving walls at t = 1e9" *
          doctest::description("they are where they are at 0; overlap below 1e-12")) {
  double deepest = 0.0;
  for (const Wall& wall : {kSawtooth, kSinusoidal}) {
    for (const double frequency : {0.5, 2.0, 0.7}) {
      CAPTURE(frequency);
      Wall moving = wall;
      moving.frequency = frequency;
      Model<2> model = with_walls(with_walls(periodic_box(10.0, 9.0), 0, moving), 1, moving);
      model.restitution = 0.9;
      model.gravity = {0.0, -0.5};
      const State<2> start = clear_gas(model, 20, 904);
      Simulation<2> early(model, start), late(model, start, 1e9);
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

TEST_CASE("Late times: everything at once from t = 1e12" *
          doctest::description("the same bits and kicks as from 0")) {
  Model<2> model = everything();
  const State<2> start = clear_gas(model, 20, 905);
  Simulation<2> early(model, start), late(model, start, 1e12);
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
