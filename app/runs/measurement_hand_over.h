#pragma once

#include <optional>

#include "engine/dynamics/simulation.h"
#include "engine/measure/measurement.h"

namespace clatter {

/// Whether averages can continue under a new model. They cannot under another gravity, under
/// another wall motion, or if spins appear, disappear or change their inertia.
template <int D>
bool averages_go_on(const RunState<D>& saved, bool same_inertia, const Model<D>& model,
                    const Measure& measure);

/// Hands a measurement up to the simulation time `end` over to the next simulation of its run,
/// after a change of laws or a puff. Its series and energy balance continue. Returns false if its
/// averages restart, as they do with other particles.
template <int D>
bool hand_over(std::optional<Measurement<D>>& measurement, const Simulation<D>& before,
               Simulation<D>& next, const Measure& measure, double end);

}  // namespace clatter
