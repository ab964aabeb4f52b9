#pragma once

#include <vector>

#include "app/view/history.h"
#include "app/view/plot.h"

namespace clatter {

/// The plots that a run has: temperature and energy over time, the profile of the heatmap, the
/// velocities' distribution, and, between driven walls, its place on Fig. 3.1.
std::vector<Plot> plots_of(const History& history, const Frame& frame);

}  // namespace clatter
