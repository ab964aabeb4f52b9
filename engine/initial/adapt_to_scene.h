#pragma once

#include <cstdint>

#include "engine/scene/scene.h"

namespace clatter {

/// Makes a start state for `scene` from the state of another scene. Particles keep their positions,
/// velocities and spins, as many as the scene has and its box has room for. Further particles get
/// random positions, Gaussian velocities of the same temperature, and no spin. In a mixture the
/// particles of each species keep the order of their sizes, and large ones come first. Without room
/// the result is start_state().
template <int D>
State<D> adapt_to_scene(const State<D>& state, const Scene& scene, std::uint64_t seed);

}  // namespace clatter
