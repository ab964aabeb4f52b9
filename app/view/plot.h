#pragma once

#include <string>

#include "render/charts/live_plot.h"

namespace clatter {

/// Draws a plot with axes and legend, `height` pixels high, over the width of the ImGui window.
void draw_plot(const LivePlot& plot, float height);

/// The data of a plot as CSV, one table per curve.
std::string csv_of(const LivePlot& plot);

}  // namespace clatter
