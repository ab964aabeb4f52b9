#pragma once

#include <cstdint>
#include <vector>

#include "engine/dynamics/event_loop.h"
#include "engine/dynamics/run_state.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Adds the flights of a puff to the state of a run under these laws, at rest and without overlaps.
/// The other lists of the state keep their lengths, and Simulation extends them. Returns the
/// velocities of the new particles. Throws PhysicalStop if a particle finds no room, or is too
/// fast.
template <int D>
std::vector<NewVelocity<D>> add_puff(RunState<D>& state, const Puff& puff, const Scene& laws,
                                     std::uint64_t seed);

}  // namespace clatter
