#pragma once

#include <optional>
#include <vector>

#include "app/view/history.h"
#include "app/view/plot.h"
#include "engine/publish/command.h"
#include "render/theme.h"

namespace clatter {

/// Names of the available profiles along an axis: the fields of LiveProfile in their order, then
/// the balance residuals.
std::vector<std::string> profile_names(Axis axis);

/// Kind of profile that a frame needs for the profile with index `name` in profile_names().
Profiled profiled_by(std::size_t name);

/// The plots of a run: the chosen profile, temperature and energy over time, the velocity
/// distribution, Fig. 3.1 and the residuals. `profiled` is an index into profile_names(). Fig. 3.1
/// needs driven, elastic walls and inelastic particles. Curves of neither a direction nor a theory
/// have the text colour of the theme.
std::vector<LivePlot> plots_of(const History& history, const Frame& frame, std::size_t profiled,
                               const ThemeColours& theme);

/// The plot of lecture mode. Absent: there is none, or the frame lacks its data.
std::optional<LivePlot> lecture_plot(LecturePlot which, const History& history, const Frame& frame,
                                     std::size_t profiled, const ThemeColours& theme);

}  // namespace clatter
