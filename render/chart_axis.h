#pragma once

#include <limits>
#include <string>
#include <vector>

namespace clatter {

/// Range of the coordinates of some values.
struct ChartExtent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  /// True if it contains no coordinate.
  bool empty() const { return low > high; }
  /// Widens the range to contain a coordinate.
  void include(double coordinate);
};

/// Mapping from values to fractions of the length of an axis.
struct ChartScale {
  double low = 0.0;  ///< coordinate of the lower end
  double high = 1.0;
  bool logarithmic = false;  ///< coordinates are decimal logarithms of values, else values

  /// True if the axis can show a value: at most 1e300 in magnitude, and on a logarithmic axis at
  /// least 1e-300.
  bool shows(double value) const;
  /// Coordinate of a value that the axis can show.
  double coordinate(double value) const;
  /// Coordinate as a fraction of the length of the axis; 0 at `low`, 1 at `high`.
  double share(double value) const { return (coordinate(value) - low) / (high - low); }
};

/// The scale that contains all coordinates of points, with some room at both ends. Coordinates of
/// lines widen it at each end by at most the span of the points, so that a diverging line does not
/// compress the points. Without points it contains the lines. Without both its range is 0..1.
ChartScale chart_scale(ChartExtent points, ChartExtent lines, bool logarithmic);

/// A tick of an axis.
struct ChartTick {
  double value = 0.0;
  std::string text;  ///< number beside the tick; empty: a minor tick
};

/// The ticks of an axis, about `most` >= 2 of them with numbers, and at least two. A linear axis
/// has multiples of 1, 2 or 5 times a power of ten. A logarithmic axis has powers of ten; if it
/// contains fewer than two of these, also their multiples by 2 and 5; if it contains fewer than two
/// of all these, the ticks of a linear axis.
std::vector<ChartTick> chart_ticks(const ChartScale& scale, int most);

}  // namespace clatter
