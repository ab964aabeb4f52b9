#include "app/view/plot.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/controls.h"
#include "engine/scene/text.h"
#include "render/colour_range.h"
#include "render/layers/fonts.h"
#include "render/theme.h"

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
      ticks.push_back({share, fmt::format("{:.2g}", std::pow(10.0, place))});
    } else if (place == std::round(place)) {
      ticks.push_back({share, fmt::format("{:.0e}", std::pow(10.0, place))});
    }
  }
  return ticks;
}

// The area inside the axes of a plot, and its scales.
struct PlotFrame {
  ImVec2 low, high;  // upper left and lower right corner, window units
  PlotScale x, y;

  ImVec2 at(const Vec2& point) const {
    return {low.x + static_cast<float>(x.share(point.x())) * (high.x - low.x),
            high.y - static_cast<float>(y.share(point.y())) * (high.y - low.y)};
  }
};

void draw_axes(ImDrawList& list, const PlotFrame& frame, const LivePlot& plot) {
  const ImFont& font = *ImGui::GetFont();
  const float size = 0.8f * ImGui::GetFontSize();
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border);
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const auto extent = [&](const std::string& text) {
    return font.CalcTextSizeA(size, FLT_MAX, 0.0f, text.c_str());
  };
  const auto write = [&](ImVec2 at, const std::string& text) {
    list.AddText(&font, size, at, ink, text.c_str());
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
    return std::isfinite(curve.points[i].y()) && std::isfinite(curve.errors[i]);
  };
  for (std::size_t i = 1; i < curve.errors.size(); ++i) {
    if (!shows(i - 1) || !shows(i)) continue;
    list.AddQuadFilled(edge(i - 1, -1.0), edge(i, -1.0), edge(i, 1.0), edge(i - 1, 1.0), ink);
  }
}

void draw_curve(ImDrawList& list, const PlotFrame& frame, const Curve& curve) {
  const ImU32 ink = packed(curve.colour);
  const float width = 0.1f * ImGui::GetFontSize();
  if (curve.as_point) {
    if (!curve.points.empty()) {
      list.AddCircleFilled(frame.at(curve.points.back()), 0.3f * ImGui::GetFontSize(), ink);
    }
    return;
  }
  std::vector<ImVec2> run;
  const auto stroke = [&] {
    if (run.size() > 1) list.AddPolyline(run.data(), static_cast<int>(run.size()), ink, 0, width);
    run.clear();
  };
  for (const Vec2& point : curve.points) {
    if (frame.x.shows(point.x()) && frame.y.shows(point.y())) {
      run.push_back(frame.at(point));
    } else {
      stroke();
    }
  }
  if (!curve.dashed) return stroke();
  // Each segment starts with a dash. This suffices for the smooth curves of the theory.
  const float dash = 0.4f * ImGui::GetFontSize();
  for (std::size_t i = 1; i < run.size(); ++i) {
    const ImVec2 a = run[i - 1], b = run[i];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    for (float s = 0.0f; s < length; s += 2.0f * dash) {
      const float e = std::min(s + dash, length);
      list.AddLine(ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length),
                   ImVec2(a.x + (b.x - a.x) * e / length, a.y + (b.y - a.y) * e / length), ink,
                   width);
    }
  }
}

void legend(const LivePlot& plot) {
  const float unit = ImGui::GetFontSize();
  float x = 0.0f;
  for (const Curve& curve : plot.curves) {
    if (curve.name.empty()) continue;
    const float width = ImGui::CalcTextSize(curve.name.c_str()).x + 1.6f * unit;
    if (x > 0.0f && x + width < ImGui::GetContentRegionMax().x) {
      ImGui::SameLine(0.0f, 0.6f * unit);
    } else {
      x = 0.0f;
    }
    x += width;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + 0.55f * unit;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (curve.as_point) {
      list.AddCircleFilled(ImVec2(at.x + 0.35f * unit, y), 0.25f * unit, packed(curve.colour));
    } else if (curve.dashed) {
      list.AddLine(ImVec2(at.x, y), ImVec2(at.x + 0.3f * unit, y), packed(curve.colour), 2.0f);
      list.AddLine(ImVec2(at.x + 0.45f * unit, y), ImVec2(at.x + 0.75f * unit, y),
                   packed(curve.colour), 2.0f);
    } else {
      list.AddLine(ImVec2(at.x, y), ImVec2(at.x + 0.75f * unit, y), packed(curve.colour), 2.0f);
    }
    ImGui::Dummy(ImVec2(0.75f * unit, unit));
    ImGui::SameLine(0.0f, 0.25f * unit);
    ImGui::TextDisabled("%s", curve.name.c_str());
    if (!curve.help.empty() && ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%s", curve.help.c_str());
    }
  }
}

}  // namespace

bool PlotScale::shows(double value) const {
  return std::isfinite(value) && (!logarithmic || std::max(value, floor) > 0.0);
}

double PlotScale::place(double value) const {
  return logarithmic ? std::log10(std::max(value, floor)) : value;
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

void draw_plot(const LivePlot& plot, float height) {
  const float unit = ImGui::GetFontSize();
  const float button = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("CSV").x - unit;
  ImGui::PushTextWrapPos(button);
  ImGui::TextUnformatted(plot.title.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SameLine();
  if (ImGui::GetCursorPosX() + ImGui::CalcTextSize(plot.y_label.c_str()).x < button) {
    ImGui::TextDisabled("%s", plot.y_label.c_str());
  }
  ImGui::SameLine(button);
  ImGui::PushID(plot.title.c_str());
  const Reach reach(ImGui::GetFontSize());
  if (ImGui::SmallButton("CSV")) ImGui::SetClipboardText(csv_of(plot).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Copy the numbers");
  ImGui::PopID();
  legend(plot);

  const auto [x, y] = scales_of(plot);
  PlotFrame frame{{}, {}, x, y};
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  frame.low = ImVec2(corner.x + 3.0f * unit, corner.y + 0.4f * unit);
  frame.high = ImVec2(corner.x + width - 0.5f * unit, corner.y + height - 2.1f * unit);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_axes(list, frame, plot);
  list.PushClipRect(frame.low, ImVec2(frame.high.x, frame.high.y + 1.0f), true);
  for (const Curve& curve : plot.curves) {
    if (!curve.errors.empty()) draw_band(list, frame, curve);
    draw_curve(list, frame, curve);
  }
  list.PopClipRect();
  ImGui::Dummy(ImVec2(width, height));
}

std::string csv_of(const LivePlot& plot) {
  std::string text;
  for (const Curve& curve : plot.curves) {
    text += plot.x_label + ',' + (curve.name.empty() ? plot.title : curve.name);
    text += curve.errors.empty() ? "\n" : ",standard error\n";
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      text += number_text(curve.points[i].x()) + ',' + number_text(curve.points[i].y());
      text += curve.errors.empty() ? "\n" : ',' + number_text(curve.errors[i]) + '\n';
    }
    text += '\n';
  }
  return text;
}

}  // namespace clatter
