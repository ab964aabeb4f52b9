#pragma once

#include <cstddef>
#include <vector>

#include "engine/physics/lattice.h"
#include "engine/physics/random.h"
#include "engine/stop_request.h"

namespace clatter {

/// Random sequential insertion of `count` centres, each uniform over the free room. Empty if a
/// particle finds no room. The process jams at a packing fraction of 0.547 for disks (Feder 1980)
/// and 0.384 for spheres (Torquato, Uche & Stillinger 2006). Throws Interrupted.
template <int D>
std::vector<Vec<D>> random_insertion(const Room<D>& room, int count, Random& random,
                                     const StopRequest& stop = {});

/// The same, after the insertion of those positions of `wanted`, in order, that fit without
/// overlap. `kept` gets their indices.
template <int D>
std::vector<Vec<D>> random_insertion(const Room<D>& room, int count, Random& random,
                                     const std::vector<Vec<D>>& wanted,
                                     std::vector<std::size_t>& kept, const StopRequest& stop = {});

}  // namespace clatter
