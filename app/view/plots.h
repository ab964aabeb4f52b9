#pragma once

#include <vector>

#include "app/view/history.h"
#include "app/view/plot.h"
#include "render/theme.h"

namespace clatter {

/// The fields of which there are profiles, in the order of LiveProfile's.
inline const std::vector<std::string> kProfileNames = {"density", "temperature", "stress xx",
                                                       "heat flux x", "dissipation"};

/// The plots that a run has: the profile of the field that is asked for, temperature and energy
/// over time, the velocities' distribution, between driven walls its place on Fig. 3.1, and what
/// its books leave open. What is neither one direction nor theory has the colour of the theme's
/// text.
std::vector<LivePlot> plots_of(const History& history, const Frame& frame, std::size_t profiled,
                               const ThemeColours& theme);

}  // namespace clatter
