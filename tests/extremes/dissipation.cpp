#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "engine/dynamics/start.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"
#include "tests/physics/experiment.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Simulation<2> cooling(double restitution, std::optional<double> contact_time, int count,
                      std::uint64_t seed) {
  Scene scene = gas_of_fraction(0.5, count, restitution);
  scene.contact_time = contact_time;
  return {model_of(scene, seed), start_state(scene, seed)};
}

double temperature(const Simulation<2>& simulation) {
  return simulation.kinetic_energy() / static_cast<double>(simulation.disks().size());
}

}  // namespace

// 1000 seeds of 200 disks: each T(4) varies by some 10 %, the ratio of means by .4 %.
TEST_CASE("alpha = 0, .1, .3 at phi = .5, t_c = 1e-5 and 1e-3" * doctest::test_suite("slow") *
          doctest::description("T(4) the same for both within 2 %")) {
  for (const double restitution : {0.0, 0.1, 0.3}) {
    Sample shorter, longer;
    for (std::uint64_t seed = 1000; seed < 2000; ++seed) {
      for (const double contact_time : {1e-5, 1e-3}) {
        Simulation<2> simulation = cooling(restitution, contact_time, 200, seed);
        simulation.run_until(4.0);
        (contact_time == 1e-5 ? shorter : longer).add(temperature(simulation));
        REQUIRE(simulation.checks().deepest_overlap < 1e-9);
      }
    }
    const double off = longer.mean() / shorter.mean() - 1.0;
    const double error = std::hypot(longer.standard_error(), shorter.standard_error());
    MESSAGE("alpha = ", restitution, ": T(4) = ", brief(shorter.mean()), ", with 1e-3 ",
            brief(100.0 * off), " +- ", brief(100.0 * error / shorter.mean()), " % off");
    CHECK(std::fabs(off) < 0.02);
  }
}

TEST_CASE("alpha = 0, .1, .3 at phi = .5 without t_c" *
          doctest::description("a clean stop or completion, never a hang; overlap below 1e-9")) {
  int stops = 0, runs = 0;
  double deepest = 0.0;
  for (const double restitution : {0.0, 0.1, 0.3}) {
    for (std::uint64_t seed = 930; seed < 934; ++seed) {
      Simulation<2> simulation = cooling(restitution, std::nullopt, 200, seed);
      const std::string stop = stop_of(simulation, 1000.0);
      if (stop.empty()) CHECK(simulation.time() == 1000.0);
      if (!stop.empty()) CHECK(stop.find("inelastic collapse") != std::string::npos);
      CHECK(finite_and_inside(simulation.model(), simulation.state()));
      deepest = std::max(deepest, simulation.checks().deepest_overlap);
      stops += !stop.empty();
      ++runs;
    }
  }
  MESSAGE(stops, " of ", runs, " stop, deepest overlap ", brief(deepest));
  CHECK(deepest < 1e-9);
}

// Velocities are 1e-15 at the end, and what rounding did to the momentum while they were 1 remains:
// only so long as the energy of the drift is small is T that of the motion within the gas.
TEST_CASE(
    "Haff's cooling down to T = 1e-30" *
    doctest::description("T = T_0/(1 + k t)^2, so T t^2 constant within 20 % below T = 1e-10; "
                         "the drift of the centre has less than 1 % of the energy")) {
  const Scene scene = gas_of_fraction(0.1, 64, 0.9);
  Simulation<2> simulation(model_of(scene, 951), start_state(scene, 951));
  double least = kNever, most = 0.0;
  double time = 1.0;
  while (temperature(simulation) > 1e-30) {
    time *= 2.0;
    simulation.run_until(time);
    const double t = temperature(simulation);
    if (t > 1e-10) continue;
    least = std::min(least, t * time * time);
    most = std::max(most, t * time * time);
  }
  const double drift = momentum(simulation.state()).squaredNorm() / (2.0 * 64.0);
  MESSAGE("T = ", brief(temperature(simulation)), " at t = ", brief(time), " after ",
          simulation.counts().disk_disk, " collisions; T t^2 from ", brief(least), " to ",
          brief(most), "; share of the drift ", brief(drift / simulation.kinetic_energy()));
  CHECK(most / least < 1.2);
  CHECK(drift < 1e-2 * simulation.kinetic_energy());
  check_sound(simulation);
}
