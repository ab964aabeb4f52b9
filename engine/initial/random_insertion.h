#pragma once

#include <cstddef>
#include <vector>

#include "engine/physics/lattice.h"
#include "engine/physics/random.h"

namespace clatter {

/// `count` centres placed one after the other, each uniformly where it overlaps none before; empty
/// where no place was found for one. The process itself jams at a packing fraction of 0.547 for
/// disks (Feder 1980) and 0.384 for spheres (Torquato, Uche & Stillinger 2006).
template <int D>
std::vector<Vec<D>> random_insertion(const Room<D>& room, int count, Random& random);

/// The same, after as many of `wanted` as fit into the room and overlap none before; `kept` holds
/// the indices of these.
template <int D>
std::vector<Vec<D>> random_insertion(const Room<D>& room, int count, Random& random,
                                     const std::vector<Vec<D>>& wanted,
                                     std::vector<std::size_t>& kept);

}  // namespace clatter
