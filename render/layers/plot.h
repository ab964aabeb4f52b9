#pragma once

#include <string>
#include <vector>

#include "render/context/gl.h"
#include "render/output/image.h"
#include "render/theme.h"

namespace clatter {

/// A point of a plot.
struct PlotPoint {
  double x = 1.0;     ///< > 0
  double y = 1.0;     ///< > 0; lower than the axis goes: drawn on it
  std::string label;  ///< beside it, where there is room
  bool hollow = false;
};

/// Points in their order, joined by a line.
struct PlotPanel {
  std::string title;
  std::vector<PlotPoint> points;
};

/// Panels beside and below each other, all with the same logarithmic axes.
struct Plot {
  std::string title;
  std::string caption;
  std::string x_name;
  std::string y_name;
  std::vector<PlotPanel> panels;
};

/// A picture of a plot. Throws RunError where it cannot be drawn.
Image plot_image(const Gl& gl, const Plot& plot, Size size, const ThemeColours& theme);

}  // namespace clatter
