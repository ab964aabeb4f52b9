#pragma once

#include <cstdint>
#include <vector>

#include "engine/dynamics/run_state.h"
#include "engine/scene/scene.h"
#include "engine/vec.h"

namespace clatter {

/// A particle that enters the gas.
template <int D>
struct PuffParticle {
  Vec<D> position;
  Vec<D> velocity;
  Grain grain = {};  ///< what it is, if the gas is a mixture
};

/// The particles of a puff that enters the gas of a saved run under these laws, without overlaps.
/// Fewer than its count if the next one finds no room. Throws PhysicalStop if one is too fast.
template <int D>
std::vector<PuffParticle<D>> puff_particles(const RunState<D>& state, const Puff& puff,
                                            const Scene& laws, std::uint64_t seed);

}  // namespace clatter
