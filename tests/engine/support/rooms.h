#pragma once

#include <array>
#include <vector>

#include "engine/physics/lattice.h"

namespace clatter::testing {

/// The least distance of two of these centres through any image, and of a centre from its own
/// images, by looking at all pairs; the search ends below `enough`.
template <int D>
double least_distance(const Room<D>& room, const std::vector<Vec<D>>& centres, double enough = 0.0);

/// Whether all centres lie in the box, and half a diameter or more from its walls, up to a
/// rounding.
template <int D>
bool all_inside(const Room<D>& room, const std::vector<Vec<D>>& centres, double rounding = 0.0);

/// Every combination of walled and periodic axes.
template <int D>
std::vector<std::array<bool, D>> all_walls();

}  // namespace clatter::testing
