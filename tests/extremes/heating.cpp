#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "engine/dynamics/start.h"
#include "engine/physics/theory.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"
#include "tests/physics/experiment.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("100 disks between walls of restitution 1.05" *
          doctest::description("a clean stop, time within 5 % of t* of Eq. (3.10)")) {
  // alpha = 1, alpha_w = 1.05, no drive, N = 100, 20 x 25: T = T_0/(1 + k t)^2 with k < 0,
  // corrected for the layer at the walls, section 5, so t* = 1/|k|. 6 seeds, mean t* to 1 %, within
  // 5 %.
  constexpr int kSeeds = 6;
  Scene scene = gas(20.0, 25.0, 100, 1.0);
  wall_in(scene, 0, {.kind = WallKind::Static, .restitution = 1.05});
  const VibratedGas theory{100.0, 20.0, 25.0, 1.0, 1.05, 0.0};
  const double expected = divergence_time(theory.haff_rate_corrected(1.0));
  Sample times;
  for (std::uint64_t seed = 501; seed < 501 + kSeeds; ++seed) {
    Simulation<2> simulation(model_of(scene, seed), start_state(scene, seed));
    const std::string message = stop_of(simulation, 10.0 * expected);
    CHECK(message.find("the temperature diverges") != std::string::npos);
    times.add(simulation.time());
    CHECK(std::isfinite(simulation.kinetic_energy()));
    CHECK(simulation.kinetic_energy() > 1e6 * 100.0);
    CHECK(finite_and_inside(simulation.model(), simulation.state()));
    CHECK(simulation.deepest_overlap() < 1e-9);
  }
  MESSAGE("t* = ", times.mean(), " +- ", times.standard_error(), ", theory ", expected,
          ", without the layer ", divergence_time(theory.haff_rate_refined(1.0)));
  CHECK(times.standard_error() < 0.01 * expected);
  CHECK(std::fabs(times.mean() / expected - 1.0) < 0.05);
}
