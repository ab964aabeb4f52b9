#include "render/charts/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/typeset_number.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_layer.h"

namespace clatter {

namespace {

// A logarithmic axis between whole or half powers of ten.
struct PlotAxis {
  double low = 0.0;   // decimal logarithm of the lower end
  double high = 1.0;  // decimal logarithm of the upper end

  double share(double value) const {
    return std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0);
  }
};

// The axis that contains all values up to this number of decades below the largest.
template <class Coordinate>
PlotAxis axis_of(const Plot& plot, double most_decades, Coordinate coordinate) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotPoint& point : panel.points) {
      const double value = std::log10(coordinate(point));
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(low <= high)) return {};
  constexpr double kRoom = 0.15;
  high = 0.5 * std::ceil(2.0 * (high + kRoom));
  low = 0.5 * std::floor(2.0 * (std::max(low, high - most_decades) - kRoom));
  return {low, high};
}

struct Rectangle {
  ImVec2 low, high;  // upper left and lower right corner

  bool meets(const Rectangle& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y;
  }
  bool is_current(const Rectangle& other) const {
    return low.x <= other.low.x && other.high.x <= high.x && low.y <= other.low.y &&
           other.high.y <= high.y;
  }
};

Colour faded(Colour colour, int alpha) {
  colour.alpha = static_cast<unsigned char>(alpha);
  return colour;
}

// Draws one panel into its frame.
class PanelDrawing {
 public:
  PanelDrawing(ImDrawList& list, const Fonts& fonts, const ThemeColours& theme,
               const Rectangle& frame, const PlotAxis& x, const PlotAxis& y)
      : list_(list), fonts_(fonts), theme_(theme), frame_(frame), x_(x), y_(y) {}

  void draw(const PlotPanel& panel, bool names_x, bool names_y) {
    draw_axis(x_, true, names_x);
    draw_axis(y_, false, names_y);
    const float title = frame_.low.y - 1.5f * fonts_.unit();
    draw_text(list_, fonts_.text, ImVec2(frame_.low.x, title), theme_.ink(), panel.title);
    draw_line(panel);
    for (const PlotPoint& point : panel.points) draw_point(point);
    for (const PlotPoint& point : panel.points) draw_label(point);
  }

 private:
  ImVec2 place(double x, double y) const {
    const auto between = [](float low, float high, double share) {
      return low + static_cast<float>(share) * (high - low);
    };
    return {between(frame_.low.x, frame_.high.x, x), between(frame_.high.y, frame_.low.y, y)};
  }
  ImVec2 place(const PlotPoint& point) const {
    return place(x_.share(point.x), point.y > 0.0 ? y_.share(point.y) : 0.0);
  }

  // Lines at the powers of ten, fainter lines at their multiples.
  void draw_axis(const PlotAxis& axis, bool across, bool named) {
    for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade) {
      for (int multiple = 1; multiple < 10; ++multiple) {
        const double value = multiple * std::pow(10.0, decade);
        const double at = std::log10(value);
        if (at < axis.low - 1e-9 || at > axis.high + 1e-9) continue;
        const double share = axis.share(value);
        const ImU32 colour = packed(faded(theme_.static_wall, multiple == 1 ? 90 : 28));
        list_.AddLine(across ? place(share, 0.0) : place(0.0, share),
                      across ? place(share, 1.0) : place(1.0, share), colour);
        if (named && multiple == 1) draw_number(value, share, across);
      }
    }
  }

  void draw_number(double value, double share, bool across) {
    const std::string text = typeset_number(fmt::format("{:g}", value));
    const ImVec2 extent = text_extent(fonts_.small, text);
    const float gap = 0.4f * fonts_.unit();
    ImVec2 at = across ? place(share, 0.0) : place(0.0, share);
    at = across ? ImVec2(at.x - 0.5f * extent.x, at.y + gap)
                : ImVec2(at.x - extent.x - gap, at.y - 0.5f * extent.y);
    draw_text(list_, fonts_.small, at, theme_.faint_ink(), text);
  }

  void draw_line(const PlotPanel& panel) {
    for (std::size_t k = 1; k < panel.points.size(); ++k) {
      if (panel.points[k - 1].apart || panel.points[k].apart) continue;
      const ImVec2 a = place(panel.points[k - 1]), b = place(panel.points[k]);
      list_.AddLine(a, b, packed(faded(theme_.driven_wall, 110)), 0.1f * fonts_.unit());
      // Labels keep off the line.
      const float steps = std::ceil(std::hypot(b.x - a.x, b.y - a.y) / (0.25f * fonts_.unit()));
      for (float step = 0.0f; step <= steps; ++step) {
        const ImVec2 at(a.x + (b.x - a.x) * step / steps, a.y + (b.y - a.y) * step / steps);
        taken_.push_back({at, {at.x + 1.0f, at.y + 1.0f}});
      }
    }
  }

  void draw_point(const PlotPoint& point) {
    const float radius = 0.3f * fonts_.unit();
    const ImVec2 at = place(point);
    list_.AddCircleFilled(at, radius, packed(point.hollow ? theme_.background : theme_.driven_wall),
                          32);
    list_.AddCircle(at, radius, packed(theme_.driven_wall), 32, 0.12f * fonts_.unit());
    taken_.push_back({{at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}});
  }

  // Draws the label on the first side of the point that is free, or not at all.
  void draw_label(const PlotPoint& point) {
    const ImVec2 extent = text_extent(fonts_.small, point.label), at = place(point);
    const float gap = 0.5f * fonts_.unit();
    const std::array<ImVec2, 6> sides = {{{-0.5f * extent.x, -gap - extent.y},
                                          {gap, -0.5f * extent.y},
                                          {-gap - extent.x, -0.5f * extent.y},
                                          {-0.5f * extent.x, gap},
                                          {0.6f * gap, -gap - 0.8f * extent.y},
                                          {0.6f * gap, gap - 0.2f * extent.y}}};
    for (const ImVec2& side : sides) {
      const ImVec2 corner(at.x + side.x, at.y + side.y);
      const Rectangle label{corner, {corner.x + extent.x, corner.y + extent.y}};
      const bool covers =
          std::ranges::any_of(taken_, [&](const Rectangle& other) { return label.meets(other); });
      if (covers || !frame_.is_current(label)) continue;
      draw_text(list_, fonts_.small, corner, point.hollow ? theme_.faint_ink() : theme_.ink(),
                point.label);
      taken_.push_back(label);
      return;
    }
  }

  ImDrawList& list_;
  const Fonts& fonts_;
  const ThemeColours& theme_;
  Rectangle frame_;
  PlotAxis x_, y_;
  std::vector<Rectangle> taken_;  // areas of lines, points and labels
};

void draw_page(ImDrawList& list, const Fonts& fonts, const Plot& plot, Size size,
               const ThemeColours& theme) {
  const float unit = fonts.unit(), edge = std::round(1.5f * unit);
  const float width = static_cast<float>(size.width) - 2.0f * edge;
  draw_text(list, fonts.title, ImVec2(edge, edge), theme.ink(), plot.title);
  float top = edge + 2.0f * unit;
  draw_text(list, fonts.text, ImVec2(edge, top), theme.faint_ink(), plot.caption, width);
  top += text_extent(fonts.text, plot.caption, width).y + unit;
  draw_text(list, fonts.small, ImVec2(edge, top), theme.faint_ink(), plot.y_name);
  top += 2.0f * unit;

  const auto count = static_cast<int>(plot.panels.size());
  // For panels slightly wider than high.
  const int columns =
      std::clamp(static_cast<int>(std::ceil(std::sqrt(1.6 * count))), 1, std::max(1, count));
  const int rows = std::max(1, (count + columns - 1) / columns);
  const float left = edge + 2.5f * unit, bottom = size.height - edge - 3.0f * unit;
  const float across = (size.width - edge - left) / static_cast<float>(columns);
  const float down = (bottom - top) / static_cast<float>(rows);
  constexpr double kAllDecades = 600.0, kErrorDecades = 4.0;
  const PlotAxis x = axis_of(plot, kAllDecades, [](const PlotPoint& point) { return point.x; });
  const PlotAxis y = axis_of(plot, kErrorDecades, [](const PlotPoint& point) { return point.y; });
  for (int k = 0; k < count; ++k) {
    const int column = k % columns, row = k / columns;
    const ImVec2 corner(std::round(left + across * column), std::round(top + down * row));
    const Rectangle frame{{corner.x, corner.y + 1.2f * unit},
                          {corner.x + across - 1.5f * unit, corner.y + down - unit}};
    PanelDrawing(list, fonts, theme, frame, x, y)
        .draw(plot.panels[static_cast<std::size_t>(k)], k + columns >= count, column == 0);
  }
  const float name = text_extent(fonts.small, plot.x_name).x;
  draw_text(list, fonts.small,
            ImVec2(size.width - edge - name, static_cast<float>(size.height) - edge - unit),
            theme.faint_ink(), plot.x_name);
}

}  // namespace

Image plot_image(const Gl& gl, const Plot& plot, Size size, const ThemeColours& theme) {
  Fonts fonts;
  return gui_picture(
      gl, size, theme.background,
      [&](ImFontAtlas& atlas) { fonts = add_fonts(atlas, std::round(size.height / 55.0f)); },
      [&](ImDrawList& list) { draw_page(list, fonts, plot, size, theme); });
}

}  // namespace clatter
