#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "render/charts/chart.h"
#include "render/palette.h"

namespace clatter {

/// How a line of a chart is drawn.
struct ChartStroke {
  Colour colour;
  double width = 1.0;  ///< in pixels
  LineStyle style = LineStyle::Solid;

  /// Lengths of the dashes and of the gaps between them, in pixels; 0: a line without gaps.
  std::array<double, 2> dashes() const;
};

/// The point of a text that is at its place: on its baseline.
enum class TextAlign { Left, Middle, Right };

/// How a text of a chart is drawn.
struct ChartLettering {
  double size = 10.0;  ///< in pixels per em
  TextAlign align = TextAlign::Left;
  bool upwards = false;  ///< turned by 90 degrees
};

/// The colour of the frame and the texts.
inline constexpr Colour kChartInk{0x00, 0x00, 0x00};

/// The colour of the background.
inline constexpr Colour kChartPaper{0xff, 0xff, 0xff};

/// A surface for charts. Places are in pixels from its upper left corner.
class ChartPen {
 public:
  virtual ~ChartPen() = default;

  /// Draws a line through the points of a path.
  virtual void line(std::span<const Vec2> path, const ChartStroke& stroke) = 0;
  /// Draws a closed polygon. Each of its points is visible from its centre.
  virtual void polygon(std::span<const Vec2> corners, Colour fill, const ChartStroke& edge) = 0;
  /// Draws a circle.
  virtual void circle(Vec2 centre, double radius, Colour fill, const ChartStroke& edge) = 0;
  /// Writes a text of one line.
  virtual void text(Vec2 place, const std::string& text, const ChartLettering& lettering) = 0;
};

/// Number of sizes of letters in a chart.
inline constexpr std::size_t kChartLetterSizes = 6;

/// The sizes of letters in a chart of this size, in pixels per em: title, text, numbers, and
/// smaller ones for long legends.
std::array<double, kChartLetterSizes> chart_letter_sizes(Size size);

/// All letters that a chart can contain.
std::string chart_letters(const Chart& chart);

/// Draws a chart of `size` pixels.
void draw_chart(const Chart& chart, Size size, ChartPen& pen);

}  // namespace clatter
