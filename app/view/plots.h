#pragma once

#include <vector>

#include "app/view/history.h"
#include "app/view/plot.h"
#include "engine/publish/command.h"
#include "render/theme.h"

namespace clatter {

/// Names of the fields of which there are profiles, in the order of LiveProfile's, and behind them
/// what the balance equations leave open.
std::vector<std::string> profile_names();

/// What a frame must have a profile of for that of a name to be drawn.
Profiled profiled_by(std::size_t name);

/// The plots that a run has: the profile that is asked for, one of profile_names(), temperature and
/// energy over time, the velocities' distribution, between driven walls its place on Fig. 3.1, and
/// what its books leave open. What is neither one direction nor theory has the colour of the
/// theme's text.
std::vector<LivePlot> plots_of(const History& history, const Frame& frame, std::size_t profiled,
                               const ThemeColours& theme);

}  // namespace clatter
