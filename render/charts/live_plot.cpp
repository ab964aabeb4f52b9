#include "render/charts/live_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/text.h"
#include "render/colour_range.h"
#include "render/typeset_number.h"
#include "render/typography/fonts.h"

namespace clatter {

namespace {

struct Tick {
  double share;
  std::string text;
};

// Ticks at round values; on a long logarithmic axis at powers of ten.
std::vector<Tick> ticks_of(const PlotScale& scale, int count) {
  std::vector<Tick> ticks;
  const auto places = round_ticks(scale.low, scale.high, count);
  for (const double place : places) {
    const double share = (place - scale.low) / (scale.high - scale.low);
    if (!scale.logarithmic) {
      const double step = places.size() > 1 ? places[1] - places[0] : 1.0;
      ticks.push_back({share, tick_text(place, step)});
    } else if (scale.high - scale.low < 1.5) {
      ticks.push_back({share, typeset_number(fmt::format("{:.2g}", std::pow(10.0, place)))});
    } else if (place == std::round(place)) {
      ticks.push_back({share, typeset_number(fmt::format("{:g}", std::pow(10.0, place)))});
    }
  }
  return ticks;
}

void draw_axes(ImDrawList& list, const PlotFrame& frame, const LivePlot& plot,
               const PlotStyle& style) {
  const Font& font = style.numbers;
  const float size = font.size;
  const ImU32 line = style.line, ink = style.faint;
  const auto extent = [&](const std::string& text) { return text_extent(font, text); };
  const auto write = [&](ImVec2 at, const std::string& text) {
    list.AddText(font.face, size, at, ink, text.c_str());
  };
  for (const Tick& tick : ticks_of(frame.y, 4)) {
    const float y = frame.high.y - static_cast<float>(tick.share) * (frame.high.y - frame.low.y);
    list.AddLine(ImVec2(frame.low.x, y), ImVec2(frame.high.x, y), line);
    const ImVec2 text = extent(tick.text);
    write(ImVec2(frame.low.x - text.x - 0.3f * size, y - 0.5f * text.y), tick.text);
  }
  for (const Tick& tick : ticks_of(frame.x, 4)) {
    const float x = frame.low.x + static_cast<float>(tick.share) * (frame.high.x - frame.low.x);
    list.AddLine(ImVec2(x, frame.high.y), ImVec2(x, frame.high.y + 0.25f * size), ink);
    const ImVec2 text = extent(tick.text);
    const float left = std::min(x - 0.5f * text.x, frame.high.x - text.x);
    write(ImVec2(left, frame.high.y + 0.3f * size), tick.text);
  }
  list.AddLine(ImVec2(frame.low.x, frame.high.y), frame.high, ink);
  const ImVec2 text = extent(plot.x_label);
  write(ImVec2(0.5f * (frame.low.x + frame.high.x - text.x), frame.high.y + 1.35f * size),
        plot.x_label);
}

// Band of one standard error on each side of a curve.
void draw_band(ImDrawList& list, const PlotFrame& frame, const Curve& curve) {
  const ImU32 ink = (packed(curve.colour) & ~IM_COL32_A_MASK) | (0x48u << IM_COL32_A_SHIFT);
  const auto edge = [&](std::size_t i, double side) {
    return frame.at(curve.points[i] + Vec2(0.0, side * curve.errors[i]));
  };
  const auto shows = [&](std::size_t i) {
    return frame.x.shows(curve.points[i].x()) && std::isfinite(curve.points[i].y()) &&
           std::isfinite(curve.errors[i]);
  };
  for (std::size_t i = 1; i < curve.errors.size(); ++i) {
    if (!shows(i - 1) || !shows(i)) continue;
    list.AddQuadFilled(edge(i - 1, -1.0), edge(i, -1.0), edge(i, 1.0), edge(i - 1, 1.0), ink);
  }
}

// Dashes of this length along a line. They continue from segment to segment.
void draw_dashes(ImDrawList& list, const std::vector<ImVec2>& line, ImU32 ink, float width,
                 float dash) {
  float start = 0.0f;  // of the next dash, from the beginning of the segment
  for (std::size_t i = 1; i < line.size(); ++i) {
    const ImVec2 a = line[i - 1], b = line[i];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const auto at = [&](float place) {
      return ImVec2(a.x + (b.x - a.x) * place / length, a.y + (b.y - a.y) * place / length);
    };
    float place = start;
    for (; place < length; place += 2.0f * dash) {
      const float from = std::max(place, 0.0f), to = std::min(place + dash, length);
      if (from < to) list.AddLine(at(from), at(to), ink, width);
    }
    // The last dash may continue in the next segment.
    const float next = place - length;
    start = next > dash ? next - 2.0f * dash : next;
  }
}

void draw_curve(ImDrawList& list, const PlotFrame& frame, const Curve& curve, float unit) {
  const ImU32 ink = packed(curve.colour);
  const float width = 0.1f * unit;
  if (curve.as_point) {
    if (!curve.points.empty()) {
      list.AddCircleFilled(frame.at(curve.points.back()), 0.3f * unit, ink);
    }
    return;
  }
  std::vector<ImVec2> run;
  const auto stroke = [&] {
    if (curve.dashed) {
      draw_dashes(list, run, ink, width, 0.4f * unit);
    } else if (run.size() > 1) {
      list.AddPolyline(run.data(), static_cast<int>(run.size()), ink, 0, width);
    }
    run.clear();
  };
  for (const Vec2& point : curve.points) {
    if (frame.x.shows(point.x()) && frame.y.shows(point.y())) {
      run.push_back(frame.at(point));
    } else {
      stroke();
    }
  }
  stroke();
}

}  // namespace

bool PlotScale::shows(double value) const {
  return std::isfinite(value) && (!logarithmic || std::max(value, floor) > 0.0);
}

double PlotScale::place(double value) const {
  return logarithmic ? std::log10(std::max(value, floor)) : value;
}

double PlotScale::value(double share) const {
  const double place = low + share * (high - low);
  return logarithmic ? std::pow(10.0, place) : place;
}

ImVec2 PlotFrame::at(const Vec2& point) const {
  return {low.x + static_cast<float>(x.share(point.x())) * (high.x - low.x),
          high.y - static_cast<float>(y.share(point.y())) * (high.y - low.y)};
}

Vec2 PlotFrame::point(ImVec2 place) const {
  return {x.value((place.x - low.x) / (high.x - low.x)),
          y.value((high.y - place.y) / (high.y - low.y))};
}

bool PlotFrame::contains(ImVec2 place) const {
  return place.x >= low.x && place.x < high.x && place.y >= low.y && place.y < high.y;
}

std::string slope_text(const PlotFrame& frame, const Vec2& from, const Vec2& to) {
  const bool log_x = frame.x.logarithmic, log_y = frame.y.logarithmic;
  const double run = frame.x.place(to.x()) - frame.x.place(from.x());
  const double rise = frame.y.place(to.y()) - frame.y.place(from.y());
  if (run == 0.0) return {};
  const double slope = rise / run;
  if (log_x && log_y) return fmt::format("exponent {:.3g}", slope);
  if (log_y) return fmt::format("rate {:.3g}", slope * std::numbers::ln10);
  if (log_x) return fmt::format("{:.3g} per decade", slope);
  return fmt::format("slope {:.3g}", slope);
}

std::string readout(const LivePlot& plot, const PlotFrame& frame, ImVec2 place) {
  const double x = frame.point(place).x();
  std::string text;
  for (const Curve& curve : plot.curves) {
    const auto distance = [&](const Vec2& point) {
      return std::fabs(frame.x.place(point.x()) - frame.x.place(x));
    };
    const auto near =
        std::min_element(curve.points.begin(), curve.points.end(),
                         [&](const Vec2& a, const Vec2& b) { return distance(a) < distance(b); });
    if (near == curve.points.end() || !std::isfinite(near->y())) continue;
    text += fmt::format("\n{} = {:.4g}", curve.name.empty() ? plot.title : curve.name, near->y());
  }
  return text.empty() ? text : fmt::format("{} = {:.4g}", plot.x_label, x) + text;
}

// Adds room around the data: a linear axis has at least the length `span`. Without data the ends
// are infinite, and become 0 and 1.
static void widen(PlotScale& scale, bool from_zero, double span) {
  if (scale.low > scale.high) scale.low = 0.0, scale.high = 1.0;
  if (from_zero && !scale.logarithmic && scale.low > 0.0) scale.low = 0.0;
  if (from_zero) scale.high += 0.05 * (scale.high - scale.low);
  if (!(scale.high > scale.low) || (!scale.logarithmic && scale.high - scale.low < span)) {
    const double middle = 0.5 * (scale.low + scale.high);
    const double room = std::max({1e-12, 0.5 * span, 0.1 * std::fabs(middle)});
    scale.low = middle - room;
    scale.high = middle + room;
  }
}

std::array<PlotScale, 2> scales_of(const LivePlot& plot) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  PlotScale x{kNowhere, -kNowhere, plot.log_x};
  PlotScale y{kNowhere, -kNowhere, plot.log_y, plot.floor};
  const auto include = [](PlotScale& scale, double value) {
    scale.low = std::min(scale.low, scale.place(value));
    scale.high = std::max(scale.high, scale.place(value));
  };
  for (const Curve& curve : plot.curves) {
    for (const Vec2& point : curve.points) {
      if (!x.shows(point.x()) || !y.shows(point.y())) continue;
      include(x, point.x());
      include(y, point.y());
    }
  }
  constexpr double kResolution = 1e-6;  // of the largest magnitude
  widen(x, false, 0.0);
  const double most = std::max(std::fabs(y.low), std::fabs(y.high));
  widen(y, true, std::max(plot.span, std::isfinite(most) ? kResolution * most : 0.0));
  return {x, y};
}

std::vector<LegendEntry> legend_of(const LivePlot& plot, float width, const PlotStyle& style) {
  const float unit = style.text.size, line = 1.25f * unit;
  std::vector<LegendEntry> entries;
  ImVec2 at(0.0f, 0.0f);
  for (const Curve& curve : plot.curves) {
    if (curve.name.empty()) continue;
    const float name = text_extent(style.text, curve.name).x;
    const float right = at.x + unit + name;
    if (at.x > 0.0f && right > width) at = ImVec2(0.0f, at.y + line);
    entries.push_back({&curve, at, ImVec2(at.x + unit + name, at.y + line)});
    at.x += 1.6f * unit + name;
  }
  return entries;
}

void draw_entry(ImDrawList& list, const LegendEntry& entry, ImVec2 corner, const PlotStyle& style) {
  const Curve& curve = *entry.curve;
  const float unit = style.text.size;
  const ImVec2 at(corner.x + entry.low.x, corner.y + entry.low.y);
  const float y = at.y + 0.55f * unit, width = std::max(1.0f, 0.12f * unit);
  const ImU32 ink = packed(curve.colour);
  if (curve.as_point) {
    list.AddCircleFilled(ImVec2(at.x + 0.35f * unit, y), 0.25f * unit, ink);
  } else if (curve.dashed) {
    list.AddLine(ImVec2(at.x, y), ImVec2(at.x + 0.3f * unit, y), ink, width);
    list.AddLine(ImVec2(at.x + 0.45f * unit, y), ImVec2(at.x + 0.75f * unit, y), ink, width);
  } else {
    list.AddLine(ImVec2(at.x, y), ImVec2(at.x + 0.75f * unit, y), ink, width);
  }
  list.AddText(style.text.face, unit, ImVec2(at.x + unit, at.y), style.faint, curve.name.c_str());
}

std::optional<PlotFrame> draw_axes_and_curves(ImDrawList& list, const LivePlot& plot, ImVec2 low,
                                              ImVec2 high, const PlotStyle& style) {
  const float unit = style.text.size;
  const auto [x, y] = scales_of(plot);
  const PlotFrame frame{ImVec2(low.x + 3.0f * unit, low.y + 0.4f * unit),
                        ImVec2(high.x - 0.5f * unit, high.y - 2.1f * unit), x, y};
  if (frame.low.x >= frame.high.x || frame.low.y >= frame.high.y) return std::nullopt;
  draw_axes(list, frame, plot, style);
  list.PushClipRect(frame.low, ImVec2(frame.high.x, frame.high.y + 1.0f), true);
  for (const Curve& curve : plot.curves) {
    if (!curve.errors.empty()) draw_band(list, frame, curve);
    draw_curve(list, frame, curve, unit);
  }
  list.PopClipRect();
  return frame;
}

}  // namespace clatter
