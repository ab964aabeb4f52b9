#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/sweep/sweep_table.h"
#include "render/charts/chart.h"

namespace clatter {

/// A chart of the table of a sweep.
struct SweepPlot {
  std::string x;        ///< quantity: a column, or columns and numbers joined by * and /
  std::string y;        ///< quantity
  std::string by = {};  ///< column with one series per value; empty: all axes that are not in `x`
  bool log_x = false;   ///< logarithmic x axis
  bool log_y = false;   ///< logarithmic y axis
  bool theory = false;  ///< lines of all theories of `y` in the table
  std::string x_label = {};  ///< empty: from the quantity
  std::string y_label = {};  ///< empty: from the quantity
  std::string title = {};
  std::string caption = {};
};

/// Draws the chart of a plot. `axes` are the keys of the sweep. Throws UserError if the table has
/// no such column.
Chart chart_of(const SweepTable& table, const std::vector<std::string>& axes,
               const SweepPlot& plot);

/// Writes a chart, as SVG if the name of the file ends with .svg, else as PNG. Throws RunError.
void write_chart(const std::filesystem::path& file, const Chart& chart);

}  // namespace clatter
