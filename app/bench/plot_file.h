#pragma once

#include <string>

#include "render/charts/plot.h"

namespace clatter {

/// Writes the plot of a benchmark as a PNG file of 1600 x 1000 pixels. Throws RunError if no OpenGL
/// context opens, or if the file cannot be written.
void write_plot(const std::string& file, const Plot& plot);

}  // namespace clatter
