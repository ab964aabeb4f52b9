#pragma once

#include <cstddef>
#include <vector>

#include "engine/physics/lattice.h"
#include "engine/physics/random.h"

namespace clatter {

/// `count` centres placed one after the other, each uniformly where it overlaps none before; empty
/// where no place was found for one. The process itself jams at phi = 0.547 (Feder 1980).
std::vector<Vec2> random_insertion(const Room& room, int count, Random& random);

/// The same, after as many of `wanted` as fit into the room and overlap none before; `kept` says
/// which these are.
std::vector<Vec2> random_insertion(const Room& room, int count, Random& random,
                                   const std::vector<Vec2>& wanted, std::vector<std::size_t>& kept);

}  // namespace clatter
