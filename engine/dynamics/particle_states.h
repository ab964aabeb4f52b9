#pragma once

#include <cstdint>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/particle.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// All data of particles that physical events change.
template <int D>
struct ParticleStates {
  ParticleArray<D> particles;          ///< [N] since each particle's last physical event
  LargeArray<Spin<D>> spins;           ///< [N] angular velocities, or empty
  LargeArray<double> last_collisions;  ///< [N] times on the base; empty without a t_c
  LargeArray<Vec<D>> remainders;  ///< [N] rounding errors of positions in long boxes; else empty
};

}  // namespace clatter
