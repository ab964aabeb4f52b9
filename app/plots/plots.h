#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plots/history.h"
#include "engine/live/command.h"
#include "render/charts/live_plot.h"
#include "render/theme.h"

namespace clatter {

/// Names of the available profiles along an axis: the fields of LiveProfile in their order, then
/// the balance residuals.
std::vector<std::string> profile_names(Axis axis);

/// Kind of profile that a frame needs for the profile with index `name` in profile_names().
Profiled profiled_by(std::size_t name);

/// A gas with plots.
struct PlottedGas {
  const History* history;
  const Frame* frame;  ///< with a scene
  std::string name;    ///< in the legends of plots that compare gases
};

/// One plot of several gases from plots of each: the curves that stand for the gases, named after
/// them. With `differences` the values of the first gas are subtracted from those of the others.
/// Absent: the plots have no such curves.
std::optional<LivePlot> compared_plot(const std::vector<LivePlot>& of_gases,
                                      const std::vector<std::string>& names, bool differences);

/// The plots of several gases: for each plot of the first one, its compared_plot() with those of
/// the same title. A single gas has the plots of plots_of().
std::vector<LivePlot> plots_of(const std::vector<PlottedGas>& gases, std::size_t profiled,
                               const ThemeColours& theme, bool differences);

/// The plots of a run: the chosen profile, temperature and energy over time, the velocity
/// distribution, Fig. 3.1 and the residuals. `profiled` is an index into profile_names(). Fig. 3.1
/// needs driven, elastic walls and inelastic particles. Curves of neither a direction nor a theory
/// have the text colour of the theme.
std::vector<LivePlot> plots_of(const History& history, const Frame& frame, std::size_t profiled,
                               const ThemeColours& theme);

/// The plot of lecture mode, of several gases as by compared_plot(). Absent: there is none, or a
/// frame lacks its data.
std::optional<LivePlot> lecture_plot(LecturePlot which, const std::vector<PlottedGas>& gases,
                                     std::size_t profiled, const ThemeColours& theme);

/// A plot of films, as lecture_plot().
std::optional<LivePlot> film_plot(FilmPlot which, const std::vector<PlottedGas>& gases,
                                  const ThemeColours& theme);

}  // namespace clatter
