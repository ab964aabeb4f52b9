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
  std::uint64_t slice = 1024;  // collisions, found while running
  for (bool arrived = false; !arrived; progress.update(simulation.time())) {
    if (interrupted()) return false;
    const auto began = Clock::now();
    arrived = simulation.run_until(time, simulation.counts().collisions() + slice);
    slice = Clock::now() - began < kSlice ? 2 * slice : std::max<std::uint64_t>(1, slice / 2);
  }
  return !interrupted();
}

}  // namespace clatter
