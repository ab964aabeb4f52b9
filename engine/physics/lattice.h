#pragma once

#include <array>
#include <vector>

#include "engine/vec.h"

namespace clatter {

/// The room for particle centres: a walled axis keeps centres half a diameter off each wall, a
/// periodic one wraps.
template <int D>
struct Room {
  Vec<D> box = Vec<D>::Zero();   ///< edge lengths in the unit of the diameter
  std::array<bool, D> walled{};  ///< whether walls close each axis; the others are periodic
  double diameter = 1.0;
};

/// Sites of the rectangular lattice with at least `count` sites whose closest sites lie farthest
/// apart, spread evenly over the room; empty where none holds `count` without overlap.
template <int D>
std::vector<Vec<D>> primitive_lattice(const Room<D>& room, int count);

/// The same for face-centred lattices: triangular ones in the plane, rows along x or along y, and
/// fcc in space.
template <int D>
std::vector<Vec<D>> face_centred_lattice(const Room<D>& room, int count);

/// The largest count that any of these lattices holds.
template <int D>
int lattice_capacity(const Room<D>& room);

}  // namespace clatter
