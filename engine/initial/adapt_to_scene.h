#pragma once

#include <cstdint>

#include "engine/scene/scene.h"

namespace clatter {

/// A start state for a scene from that of another: as many of its particles as the scene has and
/// its box has room for keep their places, velocities and spins; others come in at random places,
/// with Gaussian velocities of the same temperature and without spin. Where no room is found for
/// them it is start_state().
template <int D>
State<D> adapt_to_scene(const State<D>& state, const Scene& scene, std::uint64_t seed);

}  // namespace clatter
