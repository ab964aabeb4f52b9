#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/vec.h"
#include "render/context/gl.h"
#include "render/output/image.h"

namespace clatter {

/// A measured point of a chart.
struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
  double error = 0.0;  ///< half the length of the error bar along y; not positive or finite: no bar
};

/// Points with one colour and one marker. The first 16 series have different colours and shapes.
struct ChartSeries {
  std::string name;  ///< name in the legend; empty: no entry
  std::vector<ChartPoint> points;
};

/// Style of a line of a chart.
enum class LineStyle { Solid, Dashed, Dotted };

/// A line of a chart, e.g. of a theory. The frame cuts it.
struct ChartLine {
  std::string
      name;  ///< name in the legend; lines of one name and style share an entry; empty: none
  std::vector<Vec2>
      points;  ///< in the order of the line; a point that the axes cannot show is a gap
  LineStyle style = LineStyle::Solid;
  std::optional<std::size_t> series = {};  ///< series whose colour it has; absent: dark grey
};

/// An axis of a chart.
struct ChartAxis {
  std::string label;  ///< quantity, symbol and unit
  bool logarithmic = false;
};

/// A chart of measured points and lines. It omits points that its axes cannot show: values that are
/// not finite, or not positive on a logarithmic axis. The axes contain all other points with their
/// error bars. A logarithmic y axis contains at most a decade of the bar below a point.
struct Chart {
  std::string title;    ///< text above the frame
  std::string caption;  ///< text below the frame
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
  std::vector<ChartLine> lines;
};

/// The chart as an SVG file of `size` pixels, with its texts as text.
std::string chart_svg(const Chart& chart, Size size);

/// The same drawing as a picture. Throws RunError if OpenGL does not support the size.
Image chart_image(const Gl& gl, const Chart& chart, Size size);

}  // namespace clatter
