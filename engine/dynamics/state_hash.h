#pragma once

#include <cstdint>

#include "engine/physics/state.h"

namespace clatter {

/// 64-bit hash of the positions, velocities and spins in order, with -0 as 0. It chains
/// SplitMix64's finaliser, so that every bit of every number counts.
template <int D>
std::uint64_t state_hash(const State<D>& state);

}  // namespace clatter
