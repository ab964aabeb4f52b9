#pragma once

#include <vector>

#include "engine/physics/random.h"
#include "engine/scene/lattice.h"

namespace clatter {

/// `count` centres placed one after the other, each uniformly where it overlaps none before; empty
/// where no place was found for one. The process itself jams at phi = 0.547 (Feder 1980).
std::vector<Vec2> random_insertion(const Room& room, int count, Random& random);

}  // namespace clatter
