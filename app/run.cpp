#include "app/run.h"

#include <algorithm>
#include <chrono>

#include "app/interrupt.h"
#include "engine/dynamics/start.h"

namespace clatter {

std::unique_ptr<Simulation<2>> simulation_of(const Scene& scene, std::uint64_t seed) {
  return std::make_unique<Simulation<2>>(model_of(scene, seed), start_state(scene, seed));
}

bool run_until(Simulation<2>& simulation, double time, Progress& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kSlice{100};
  double slice = 1e-6 * (time - simulation.time());  // simulation time, found while running
  for (double now = simulation.time(); now < time;) {
    if (interrupted()) return false;
    const auto began = Clock::now();
    now = std::min(now + slice, time);
    simulation.run_until(now);
    slice *= Clock::now() - began < kSlice ? 2.0 : 0.5;
    progress.update(now);
  }
  return !interrupted();
}

}  // namespace clatter
