#pragma once

#include <vector>

#include "engine/physics/lattice.h"

namespace clatter::testing {

/// The least distance of two of these centres through any image, and of a centre from its own
/// images, by looking at all pairs; the search ends below `enough`.
double least_distance(const Room<2>& room, const std::vector<Vec2>& centres, double enough = 0.0);

/// Whether all centres lie in the box, and half a diameter or more from its walls, up to a
/// rounding.
bool all_inside(const Room<2>& room, const std::vector<Vec2>& centres, double rounding = 0.0);

}  // namespace clatter::testing
