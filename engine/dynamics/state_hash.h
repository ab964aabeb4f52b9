#pragma once

#include <cstdint>

#include "engine/dynamics/model.h"

namespace clatter {

/// 64 bits over the positions, velocities and spins in order, -0 taken as 0: a chain of
/// SplitMix64's finaliser, in which every bit of every number matters.
template <int D>
std::uint64_t state_hash(const State<D>& state);

}  // namespace clatter
