#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/publish/snapshot.h"

namespace clatter {

/// The gas at the simulation's time, without a field.
template <int D>
Snapshot snapshot_of(const Simulation<D>& simulation);

}  // namespace clatter
