#pragma once

#include "engine/scene/scene.h"

namespace clatter {

/// Memory of the simulation of a scene, in bytes: particles, spins, and the times of last
/// collisions, which t_c needs.
struct GasMemory {
  double particles = 0.0;
  double spins = 0.0;
  double last_collisions = 0.0;

  /// Sum of all three.
  double total() const { return particles + spins + last_collisions; }
};

/// Estimated memory of the scene's simulation, after all its puffs.
GasMemory gas_memory(const Scene& scene);

/// Throws UserError if gas_memory() exceeds available_memory(), or if there are too many particles.
void require_memory(const Scene& scene);

}  // namespace clatter
