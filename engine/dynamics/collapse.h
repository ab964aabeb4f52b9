#pragma once

#include "engine/dynamics/model.h"
#include "engine/dynamics/watchdog.h"
#include "engine/error.h"

namespace clatter {

/// What stops a run that stands still at a simulation time: why, where, and what would carry on.
template <int D>
PhysicalStop standstill(const Model<D>& model, const Watchdog& watchdog, double time,
                        double temperature);

/// The speed beyond which a particle shows that walls heat the gas without bound; kNever where they
/// do not, or what particles lose may balance it. Of a run that began with particles as fast as
/// `start_speed`.
template <int D>
double fastest_speed(const Model<D>& model, double start_speed);

/// What stops a run in which walls have made the speeds diverge.
template <int D>
PhysicalStop divergence(const Model<D>& model, double time, double temperature);

}  // namespace clatter
