#pragma once

#include <array>
#include <vector>

#include "engine/vec.h"

namespace clatter {

/// The room for particle centres. Along a walled axis centres keep half a diameter from each wall.
/// A periodic axis wraps.
template <int D>
struct Room {
  Vec<D> box = Vec<D>::Zero();   ///< edge lengths in the unit of the diameter
  std::array<bool, D> walled{};  ///< whether walls close each axis; the others are periodic
  double diameter = 1.0;
};

/// Sites of the rectangular lattice with at least `count` sites and the largest distance between
/// nearest sites, spread evenly over the room. Empty if no lattice holds `count` without overlap.
template <int D>
std::vector<Vec<D>> primitive_lattice(const Room<D>& room, int count);

/// The same for face-centred lattices: triangular in 2D, with rows along x or y, and fcc in 3D.
template <int D>
std::vector<Vec<D>> face_centred_lattice(const Room<D>& room, int count);

/// Largest number of sites of these lattices.
template <int D>
int lattice_capacity(const Room<D>& room);

}  // namespace clatter
