#pragma once

#include "engine/dynamics/model.h"
#include "engine/dynamics/watchdog.h"
#include "engine/error.h"

namespace clatter {

/// What stops a run that stands still at a simulation time: why, where, and what would carry on.
template <int D>
PhysicalStop standstill(const Model<D>& model, const Watchdog& watchdog, double time,
                        double temperature);

/// What stops a run in which walls with restitution > 1 have made the speeds diverge.
PhysicalStop divergence(double time, double temperature);

}  // namespace clatter
