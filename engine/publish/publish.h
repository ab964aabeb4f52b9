#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/publish/snapshot.h"

namespace clatter {

/// The gas at the simulation's time, without a field.
Snapshot snapshot_of(const Simulation<2>& simulation);

}  // namespace clatter
