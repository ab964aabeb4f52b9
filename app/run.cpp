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
  std::uint64_t collisions = 1024;  // per slice, found while running
  while (simulation.time() < time) {
    if (interrupted()) return false;
    const auto began = Clock::now();
    simulation.run_until(time, simulation.counts().disk_disk + collisions);
    collisions =
        Clock::now() - began < kSlice ? 2 * collisions : std::max<std::uint64_t>(1, collisions / 2);
    progress.update(simulation.time());
  }
  return !interrupted();
}

}  // namespace clatter
