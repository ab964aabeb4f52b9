#pragma once

#include <string>
#include <string_view>

#include "engine/physics/state.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Reads a start state for a scene from a CSV text: a header line that names the columns x, y, vx,
/// vy and, where the scene has spins, omega, in any order (of spheres also z and vz, and omega_x,
/// omega_y, omega_z); then a line per particle. Blank lines and those that begin with # do not
/// count; without omega nothing spins. Throws UserError at what is no such text, and where a
/// particle is outside the box, in the way of a wall or overlaps another one; `file` is the name
/// that errors carry.
AnyState parse_state(std::string_view csv, const std::string& file, const Scene& scene);

/// The state as such a text, whose numbers read back to exactly the same bits.
template <int D>
std::string state_to_csv(const State<D>& state);

}  // namespace clatter
