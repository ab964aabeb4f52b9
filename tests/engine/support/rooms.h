#pragma once

#include <array>
#include <vector>

#include "engine/physics/lattice.h"

namespace clatter::testing {

/// The least distance between two centres through any image, and between a centre and its own
/// images. Tests all pairs; ends below `enough`.
template <int D>
double least_distance(const Room<D>& room, const std::vector<Vec<D>>& centres, double enough = 0.0);

/// Whether all centres are in the box, and at least half a diameter from its walls, within rounding
/// errors.
template <int D>
bool all_inside(const Room<D>& room, const std::vector<Vec<D>>& centres, double rounding = 0.0);

/// Every combination of walled and periodic axes.
template <int D>
std::vector<std::array<bool, D>> all_walls();

}  // namespace clatter::testing
