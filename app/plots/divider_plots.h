#pragma once

#include <vector>

#include "app/plots/history.h"
#include "engine/scene/scene.h"
#include "render/charts/live_plot.h"

namespace clatter {

/// The shares of the particles on both sides of the divider over time, with the flux theory where
/// it covers the scene (theory 13.7).
LivePlot compartments_plot(const std::vector<Sample>& samples, const Scene& scene);

/// The place of the free piston over time.
LivePlot piston_plot(const std::vector<Sample>& samples, const Scene& scene, Colour plain);

}  // namespace clatter
