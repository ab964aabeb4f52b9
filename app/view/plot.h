#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/vec.h"
#include "render/palette.h"

namespace clatter {

/// A line, or points, in a plot.
struct Curve {
  std::string name;  ///< in the legend; empty: not told
  Colour colour;
  std::vector<Vec2> points;
  bool dashed = false;              ///< theory's lines are
  bool as_point = false;            ///< the last point, large, instead of a line
  std::vector<double> errors = {};  ///< [points] standard errors, drawn as a band; empty: none
};

/// Curves over a common axis, of a run that goes on.
struct LivePlot {
  std::string title;
  std::string x_label;
  bool log_x = false;
  bool log_y = false;
  std::vector<Curve> curves;
  std::string y_label = "";  ///< what it is and its unit
  double floor = 0.0;  ///< of a logarithmic axis y: what is less, as 0, stands there; 0: nowhere
};

/// An axis: from values to shares of its length.
struct PlotScale {
  double low = 0.0;  ///< its ends, < high; of a logarithmic one their logarithms to base 10
  double high = 1.0;
  bool logarithmic = false;
  double floor = 0.0;  ///< of a logarithmic one, see LivePlot

  /// Whether a value has a place on it.
  bool shows(double value) const;
  /// Where, in the unit of its ends.
  double place(double value) const;
  /// Likewise, as a share of its length.
  double share(double value) const { return (place(value) - low) / (high - low); }
};

/// The axes x and y of a plot, wide enough for all that they show.
std::array<PlotScale, 2> scales_of(const LivePlot& plot);

/// Draws a plot of this height over the width of the ImGui window, with its axes and legend.
void draw_plot(const LivePlot& plot, float height);

/// The numbers of a plot, a table per curve.
std::string csv_of(const LivePlot& plot);

}  // namespace clatter
