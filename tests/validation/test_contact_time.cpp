#include <doctest/doctest.h>

#include <cmath>

#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

// Effects of the TC model (theory 5.3; Luding & McNamara 1998) in the vibrated gas with alpha = .9
// and elastic walls. The share of elastic collisions is proportional to t_c. At a small share, T
// equals T at t_c = 0.

namespace {

// Mean time between collisions of a particle with others.
double mean_collision_time() {
  return 1.0 / run(vibrated_gas(0.9, 1.0), 100.0, 500.0, 701).collision_rate.mean;
}

Measured with_contact_time(double contact_time, double duration, std::uint64_t seed) {
  Scene scene = vibrated_gas(0.9, 1.0);
  scene.contact_time = contact_time;
  return run(scene, 300.0, duration, seed);
}

}  // namespace

TEST_CASE("Contact time: its effect vanishes with it, in proportion") {
  // The probability of another collision within a short t_c is proportional to t_c, for each of two
  // particles. The share of elastic collisions is about 2 t_c/(mean time): a three times longer t_c
  // gives about three times the share. From .3 on the gas runs away: it heats up, collides more
  // often, and more collisions are elastic.
  const double unit = mean_collision_time();
  double share = 1.0, undissipated = 1e9;
  std::uint64_t seed = 702;
  for (const double t_c : {0.03, 0.01, 0.003, 0.001, 0.0003}) {
    // Long enough for some hundred elastic collisions.
    const Measured result = with_contact_time(t_c * unit, t_c < 0.002 ? 4000.0 : 1000.0, seed++);
    const double next_share = static_cast<double>(result.elasticised) / result.pair_collisions;
    MESSAGE("t_c = ", t_c, ": share elasticised ", next_share, ", undissipated ",
            *result.undissipated_share, ", T ", result.temperature.mean);
    CHECK(next_share < 0.6 * share);
    CHECK(*result.undissipated_share < 0.6 * undissipated);
    CHECK(next_share < 4.0 * t_c);
    share = next_share;
    undissipated = *result.undissipated_share;
    check_energy_balance(result, 100);
  }
  CHECK(share < 1.2e-3);
  CHECK(undissipated < 1.2e-3);
}

TEST_CASE("Contact time: 10^-4 mean collision times change the temperature by less than 3 %") {
  const double contact_time = 1e-4 * mean_collision_time();
  const Measured with = with_contact_time(contact_time, 6000.0, 711);
  const Measured without = run(vibrated_gas(0.9, 1.0), 300.0, 6000.0, 712);
  MESSAGE("T = ", with.temperature.mean, " +- ", with.temperature.standard_error, ", without ",
          without.temperature.mean, " +- ", without.temperature.standard_error);
  CHECK(relative_error(with.temperature) < 0.008);
  CHECK(relative_error(without.temperature) < 0.008);
  CHECK(std::fabs(relative(with.temperature, without.temperature.mean)) < 0.03);
}

TEST_CASE("Contact time: 10^-4 mean collision times change the temperature by less than 1 %" *
          doctest::test_suite("slow")) {
  const double contact_time = 1e-4 * mean_collision_time();
  const Measured with = with_contact_time(contact_time, 100000.0, 713);
  const Measured without = run(vibrated_gas(0.9, 1.0), 300.0, 100000.0, 714);
  MESSAGE("T = ", with.temperature.mean, " +- ", with.temperature.standard_error, ", without ",
          without.temperature.mean, " +- ", without.temperature.standard_error);
  CHECK(relative_error(with.temperature) < 0.0025);
  CHECK(relative_error(without.temperature) < 0.0025);
  CHECK(std::fabs(relative(with.temperature, without.temperature.mean)) < 0.01);
}
