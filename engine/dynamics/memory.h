#pragma once

#include "engine/scene/scene.h"

namespace clatter {

/// Bytes that the simulation of a scene takes: those of its particles, of their spins, and of their
/// last collisions, which t_c needs.
struct GasMemory {
  double particles = 0.0;
  double spins = 0.0;
  double last_collisions = 0.0;

  /// Of all three.
  double total() const { return particles + spins + last_collisions; }
};

/// What the scene's simulation will take.
GasMemory gas_memory(const Scene& scene);

/// Throws UserError where that is more than the machine has.
void require_memory(const Scene& scene);

}  // namespace clatter
