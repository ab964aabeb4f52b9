#pragma once

#include <string>
#include <string_view>

#include "engine/physics/state.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Reads a start state for a scene from a CSV text. The header line names the columns x, y, vx, vy
/// and, if the scene has spins, omega, in any order. Spheres also have z and vz, and omega_x,
/// omega_y, omega_z. A mixture of several species needs the column species, with their names. If a
/// species has unequal diameters, the columns diameter and mass have those of its particles.
/// Without them particles have the mean diameter and mass. Each further line is a particle. Blank
/// lines and lines that begin with # are skipped. Without columns of spins all spins are 0. Throws
/// UserError for a malformed text, and for a particle that is outside the box or overlaps a wall or
/// another particle. `file` is the name for errors.
AnyState parse_state(std::string_view csv, const std::string& file, const Scene& scene);

/// The state as CSV text. Its numbers read back to exactly the same bits. `species` are those of
/// the scene.
template <int D>
std::string state_to_csv(const State<D>& state, const std::vector<Species>& species = {});

}  // namespace clatter
