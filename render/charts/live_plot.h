#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/vec.h"
#include "render/palette.h"
#include "render/typography/fonts.h"

namespace clatter {

/// A curve of a plot.
struct Curve {
  std::string name;  ///< name in the legend; empty: no entry
  Colour colour;
  std::vector<Vec2> points;
  bool dashed = false;              ///< dashed line, for theory
  bool as_point = false;            ///< draws only the last point, as a large dot
  std::vector<double> errors = {};  ///< [points] standard errors, drawn as a band; empty: none
  std::string help = {};            ///< tooltip of the name in the legend; empty: none
  bool compared = false;            ///< stands for its gas where several gases are compared
};

/// Plot of a running simulation: curves over a common x axis.
struct LivePlot {
  std::string title;
  std::string x_label;
  bool log_x = false;
  bool log_y = false;
  std::vector<Curve> curves;
  std::string y_label = "";  ///< quantity and unit of the y axis
  double floor = 0.0;  ///< on a logarithmic y axis smaller values are drawn here; 0: not drawn
  double span = 0.0;   ///< smallest length of a linear y axis, so that rounding errors are flat
};

/// Mapping from values to fractions of the length of an axis.
struct PlotScale {
  double low = 0.0;          ///< lower end, < high; on a logarithmic axis its decimal logarithm
  double high = 1.0;         ///< upper end, as `low`
  bool logarithmic = false;  ///< logarithmic scale
  double floor = 0.0;        ///< see LivePlot; used if logarithmic

  /// True if the axis can show a value.
  bool shows(double value) const;
  /// Coordinate of a value, in the unit of `low` and `high`.
  double place(double value) const;
  /// Coordinate of a value as a fraction of the length of the axis; 0 at `low`, 1 at `high`.
  double share(double value) const { return (place(value) - low) / (high - low); }
  /// Value at a fraction of the length of the axis, as of share().
  double value(double share) const;
};

/// The x and y axes of a plot. Their ranges contain all points that can be shown.
std::array<PlotScale, 2> scales_of(const LivePlot& plot);

/// The area inside the axes of a plot, and its scales.
struct PlotFrame {
  ImVec2 low, high;  ///< upper left and lower right corner, window units
  PlotScale x, y;

  /// Place of a point of the plot.
  ImVec2 at(const Vec2& point) const;
  /// Point of the plot at a place.
  Vec2 point(ImVec2 place) const;
  /// Whether a place is in the area.
  bool contains(ImVec2 place) const;
};

/// The slope between two points of a plot, with its meaning on the scales of the plot: a quotient,
/// an exponent, a rate or a change per decade. Empty if both have the same x.
std::string slope_text(const PlotFrame& frame, const Vec2& from, const Vec2& to);

/// The values of the curves at the x of a place, one line for each, below that of x. It takes the
/// nearest point of each curve. Empty without curves.
std::string readout(const LivePlot& plot, const PlotFrame& frame, ImVec2 place);

/// Letters and colours of plots.
struct PlotStyle {
  Font text;     ///< of title and legend
  Font numbers;  ///< of the axes
  ImU32 ink;     ///< colour of the title
  ImU32 faint;   ///< colour of numbers and names
  ImU32 line;    ///< colour of grid lines
};

/// The name of a curve in the legend of a plot, with a sample of its line.
struct LegendEntry {
  const Curve* curve;
  ImVec2 low, high;  ///< corners, pixels from the upper left corner of the legend
};

/// The legend of a plot, `width` pixels wide. Its entries refer to the plot.
std::vector<LegendEntry> legend_of(const LivePlot& plot, float width, const PlotStyle& style);

/// Draws an entry of the legend with its upper left corner at `corner`.
void draw_entry(ImDrawList& list, const LegendEntry& entry, ImVec2 corner, const PlotStyle& style);

/// Draws the axes and curves of a plot between two corners of a picture, if they have room. Returns
/// their area; absent: they have none.
std::optional<PlotFrame> draw_axes_and_curves(ImDrawList& list, const LivePlot& plot, ImVec2 low,
                                              ImVec2 high, const PlotStyle& style);

}  // namespace clatter
