#pragma once

#include <memory>

#include "app/progress.h"
#include "engine/dynamics/simulation.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The simulation that a scene and a seed ask for, at time 0.
std::unique_ptr<Simulation<2>> simulation_of(const Scene& scene, std::uint64_t seed);

/// Runs up to a simulation time in slices of about a tenth of a second, between which progress is
/// shown and interrupts are seen; false where the run was interrupted first.
bool run_until(Simulation<2>& simulation, double time, Progress& progress);

}  // namespace clatter
