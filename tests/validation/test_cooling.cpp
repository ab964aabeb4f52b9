#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

TEST_CASE("Cooling gas: Haff's law holds down to a hundredth of the temperature, within 4 %") {
  // phi = .1, alpha = .9, N = 100, periodic. T = T0/(1 + k t)^2 with the refined k = eps
  // omega_E(T0)/4 (theory 6.6). 1 + k t = 10 at the end. Mean over 64 seeds.
  constexpr int kSeeds = 64;
  constexpr int kTimes = 20;
  const Scene scene = gas_of_fraction(0.1, 100, 0.9);
  const double k = (1.0 - 0.9 * 0.9) * enskog_rate(0.1, 1.0) / 4.0;
  std::vector<Sample> ratios(kTimes + 1);
  for (std::uint64_t seed = 131; seed < 131 + kSeeds; ++seed) {
    Simulation<2> simulation(model_of<2>(scene, seed), start_state<2>(scene, seed));
    for (int step = 0; step <= kTimes; ++step) {
      simulation.run_until(9.0 * step / (kTimes * k));
      const double law = std::pow(1.0 + 9.0 * step / kTimes, -2.0);
      ratios[step].add(simulation.kinetic_energy() / 100.0 / law);
    }
  }
  for (int step = 0; step <= kTimes; ++step) {
    const double mean = ratios[step].mean(), error = ratios[step].standard_error();
    CAPTURE(step);
    if (step % 5 == 0) MESSAGE("T over Haff's law = ", mean, " +- ", error);
    CHECK((error < 0.01 || step == 0));
    CHECK(std::fabs(mean - 1.0) < 0.04);
  }
}

TEST_CASE("Cooling gas: Haff's law holds for nearly elastic spheres within 1 %") {
  // phi = .1, N = 500, periodic: the refined k = eps omega_E(T0)/6 (theory 6.6). Mean over 16
  // seeds, down to T0/16. Sonine's correction is -a_2 3/16 = .2 % of k at alpha = .95, that of N
  // about .1
  // %. Errors are below .3 %.
  constexpr int kTimes = 6;
  struct Runs {
    double restitution;
    std::uint64_t first_seed, seeds;
  };
  for (const auto& [restitution, first, seeds] : {Runs{0.95, 331, 64}, Runs{0.99, 347, 10}}) {
    const Scene scene = gas_of_fraction(0.1, 500, restitution, 3);
    const double k = (1.0 - restitution * restitution) * enskog_rate(0.1, 1.0, 3) / 6.0;
    std::vector<Sample> ratios(kTimes + 1);
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
      Simulation<3> simulation(model_of<3>(scene, seed), start_state<3>(scene, seed));
      for (int step = 0; step <= kTimes; ++step) {
        const double kt = 0.5 * step;
        simulation.run_until(kt / k);
        const double temperature = simulation.kinetic_energy() / (1.5 * 500.0);
        ratios[static_cast<std::size_t>(step)].add(temperature * (1.0 + kt) * (1.0 + kt));
      }
    }
    CHECK(std::fabs(ratios[0].mean() - 1.0) < 1e-12);
    for (int step = 1; step <= kTimes; ++step) {
      const Sample& ratio = ratios[static_cast<std::size_t>(step)];
      MESSAGE("alpha = ", restitution, ", k t = ", 0.5 * step,
              ": T over Haff's law = ", ratio.mean(), " +- ", ratio.standard_error());
      CHECK(ratio.standard_error() < 0.003);
      CHECK(std::fabs(ratio.mean() - 1.0) < 0.01);
    }
  }
}

TEST_CASE("Cooling gas: walls that lose heat cool elastic particles by theory 7.15") {
  // The refined rate with the wall layer: k = kappa (1 - alpha_w^2)/(pi Lx) sqrt(pi T0/2). Here
  // kappa = (1 + 2 phi chi) Lx/(Lx - a) is the enhanced wall collision rate of a dense gas.
  constexpr int kSeeds = 64;
  constexpr double kRestitution = 0.98;
  Scene scene = gas(20.0, 25.0, 100, 1.0);
  wall_in(scene, 0, {.kind = WallKind::Static, .restitution = kRestitution});
  const double phi = scene.packing_fraction();
  const double kappa = (1.0 + 2.0 * phi * contact_correlation(phi)) * 20.0 / 19.0;
  const double pi = std::acos(-1.0);
  const double k =
      std::sqrt(0.5 * pi) / (2.0 * 20.0) * kappa * (2.0 / pi) * (1.0 - kRestitution * kRestitution);
  Sample ratios;
  for (std::uint64_t seed = 231; seed < 231 + kSeeds; ++seed) {
    Simulation<2> simulation(model_of<2>(scene, seed), start_state<2>(scene, seed));
    simulation.run_until(1.0 / k);  // T = T0/4
    ratios.add(simulation.kinetic_energy() / 100.0 * 4.0);
  }
  const double mean = ratios.mean(), error = ratios.standard_error();
  MESSAGE("T over theory 7.15 = ", mean, " +- ", error);
  CHECK(error < 0.01);
  CHECK(std::fabs(mean - 1.0) < 0.04);
}
