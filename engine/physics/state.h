#pragma once

#include <cstdint>
#include <vector>

#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// Positions, velocities and spins of all particles at one time, in original order.
template <int D>
struct State {
  std::vector<Vec<D>> positions;    ///< [N] centres inside the box
  std::vector<Vec<D>> velocities;   ///< [N]
  std::vector<Spin<D>> spins = {};  ///< [N] angular velocities; empty where none are carried
};

/// Most particles that there can be.
inline constexpr std::uint32_t kMaxParticles = (1u << 28) - 1;

/// Overlaps up to this, in diameters, are the rounding of a start state's positions: runs begin
/// with them.
inline constexpr double kStartRounding = 1e-12;

}  // namespace clatter
