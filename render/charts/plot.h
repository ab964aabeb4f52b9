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
  double y = 1.0;     ///< > 0; below the range of the axis: drawn at its lower end
  std::string label;  ///< label beside the point, if there is room
  bool hollow = false;
  bool apart = false;  ///< without a line to its neighbours
};

/// A panel: points joined by a line in their order, except for those apart.
struct PlotPanel {
  std::string title;
  std::vector<PlotPoint> points;
};

/// A plot: a grid of panels with the same logarithmic axes.
struct Plot {
  std::string title;
  std::string caption;
  std::string x_name;
  std::string y_name;
  std::vector<PlotPanel> panels;
};

/// Draws a plot of `size` pixels. Throws RunError if OpenGL does not support the size.
Image plot_image(const Gl& gl, const Plot& plot, Size size, const ThemeColours& theme);

}  // namespace clatter
