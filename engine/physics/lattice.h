#pragma once

#include <array>
#include <vector>

#include "engine/vec.h"

namespace clatter {

/// The room for particle centres along x and y: a walled side keeps centres half a diameter off
/// each wall, a periodic one wraps.
struct Room {
  Vec2 box = {0.0, 0.0};                        ///< Lx, Ly in the unit of the diameter
  std::array<bool, 2> periodic = {true, true};  ///< along x, y
  double diameter = 1.0;
};

/// Sites of the rectangular lattice with at least `count` sites whose closest sites lie farthest
/// apart, spread evenly over the room; empty where none holds `count` without overlap.
std::vector<Vec2> square_lattice(const Room& room, int count);

/// The same for triangular lattices, rows along x or along y.
std::vector<Vec2> hexagonal_lattice(const Room& room, int count);

/// The largest count that any of these lattices holds.
int lattice_capacity(const Room& room);

}  // namespace clatter
