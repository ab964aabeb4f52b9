#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/plots/history.h"
#include "app/plots/plots.h"
#include "app/view/session.h"
#include "app/view/window_parts.h"
#include "render/charts/live_plot.h"
#include "render/theme.h"

namespace clatter {

/// Draws a plot with axes and legend, `height` pixels high, over the width of the ImGui window.
/// With `reads` it shows the values of the curves at the mouse. Returns the area inside the axes;
/// absent: none.
std::optional<PlotFrame> draw_plot(const LivePlot& plot, float height, bool reads = true);

/// The data of a plot as CSV, one table per curve.
std::string csv_of(const LivePlot& plot);

/// The plots of the gases in the window: their time series, a profile and the tables of the scene's
/// observables.
class PlotsPanel {
 public:
  explicit PlotsPanel(const WindowParts& parts);

  /// Chooses the axis of the profile.
  void measure_along(Axis axis) { profile_axis_ = static_cast<int>(axis); }
  /// Adds a new frame to the time series of its gases.
  void add(const Frame& frame);
  /// Draws the plots and their choices into the current ImGui window.
  void draw(const ThemeColours& theme);

  /// Number of the chosen profile in profile_names().
  std::size_t profiled() const { return static_cast<std::size_t>(profiled_); }
  /// The chosen axis of the profile; x if the box lacks it.
  Axis profile_axis() const;
  /// The gases with their time series. Requires a frame with a scene.
  std::vector<PlottedGas> gases();
  /// The titles of compared gases; empty: there is one.
  const std::vector<std::string>& titles() const { return titles_; }

 private:
  void name(const std::vector<const Frame*>& gases);
  void observable_plots(const ThemeColours& theme, float height);

  ScriptLog& log_;
  Session& session_;
  Controls& controls_;
  std::map<std::uint64_t, History> histories_;        // of the gases, by Frame::id
  std::vector<std::string> titles_;                   // of compared gases; empty: there is one
  std::vector<std::shared_ptr<const Scene>> titled_;  // scenes that have these titles
  bool differences_ = false;                          // plots show differences from the first gas
  int profiled_ = 0;                                  // index into profile_names()
  int profile_axis_ = 0;
  std::string observable_;  // table_title() of the plotted table; unknown: the first
};

}  // namespace clatter
