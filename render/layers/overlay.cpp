#include "render/layers/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/layers/wall_layer.h"
#include "render/theme.h"

namespace clatter {

namespace {

// Dear ImGui's functions act on a context that is global: ours is current only while we work, so
// that the window's own is left alone.
class CurrentContext {
 public:
  explicit CurrentContext(ImGuiContext* context) : previous_(ImGui::GetCurrentContext()) {
    ImGui::SetCurrentContext(context);
  }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  ~CurrentContext() { ImGui::SetCurrentContext(previous_); }

 private:
  ImGuiContext* previous_;
};

// From the picture's edge to the texts, in units of the layout.
constexpr float kEdge = 1.2f;

float unit_for(Size size) {
  return static_cast<float>(std::max(12.0, std::round(std::min(size.width, size.height) / 40.0)));
}

float wrap_width(Size size, const Fonts& fonts) {
  return size.width - 2.0f * std::round(kEdge * fonts.unit());
}

// Where the caption begins below the title, and where both end, from the upper edge.
struct Heading {
  float caption = 0.0f;
  float end = 0.0f;
};

Heading heading_of(const OverlayText& text, Size size, const Fonts& fonts) {
  const float wrap = wrap_width(size, fonts);
  const float edge = std::round(kEdge * fonts.unit());
  Heading heading{edge, edge};
  if (!text.title.empty()) {
    heading.end += text_extent(*fonts.title, text.title, wrap).y;
    heading.caption = heading.end + std::round(0.35f * fonts.unit());
  }
  if (!text.caption.empty()) {
    heading.end = heading.caption + text_extent(*fonts.text, text.caption, wrap).y;
  }
  return heading;
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// With a thin space between groups of three digits.
std::string grouped(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(at, "\u2009");
  return digits;
}

// The round number of diameters, at most `longest`: 1, 2 or 5 times a power of ten.
double scale_bar_length(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (double step : {5.0, 2.0}) {
    if (step * power <= longest) return step * power;
  }
  return power;
}

void draw_heading(ImDrawList& list, const OverlayText& text, Size size, const Fonts& fonts) {
  const float edge = std::round(kEdge * fonts.unit());
  const float wrap = wrap_width(size, fonts);
  draw_text(list, *fonts.title, ImVec2(edge, edge), theme::kText, text.title, wrap);
  draw_text(list, *fonts.text, ImVec2(edge, heading_of(text, size, fonts).caption),
            theme::kFaintText, text.caption, wrap);
}

// At the lower right corner; returns its left end.
float draw_scale_bar(ImDrawList& list, double diameter, const Projection& projection,
                     const Fonts& fonts) {
  const float unit = fonts.unit(), edge = std::round(kEdge * unit);
  const double pixels = diameter * projection.scale();
  const double length = scale_bar_length(0.15 * projection.size.width / pixels);
  const float right = projection.size.width - edge;
  const float left = std::round(right - length * pixels);
  const float bottom = projection.size.height - edge;
  const ImU32 colour = packed(theme::kFaintText);
  const float line = std::max(1.0f, std::round(unit / 12.0f)), cap = std::round(0.3f * unit);
  list.AddRectFilled(ImVec2(left, bottom - line), ImVec2(right, bottom), colour);
  list.AddRectFilled(ImVec2(left, bottom - cap), ImVec2(left + line, bottom), colour);
  list.AddRectFilled(ImVec2(right - line, bottom - cap), ImVec2(right, bottom), colour);

  const std::string label = formatted("%g d", length);
  const ImVec2 extent = text_extent(*fonts.small, label);
  const float middle = 0.5f * (left + right);
  const float label_left = std::round(std::min(middle - 0.5f * extent.x, right - extent.x));
  draw_text(list, *fonts.small, ImVec2(label_left, bottom - cap - extent.y), theme::kFaintText,
            label);
  return std::min(left, label_left);
}

// A row at the lower left corner; columns that would come beyond `right` are left out.
void draw_figures(ImDrawList& list, const Snapshot& snapshot, Size size, const Fonts& fonts,
                  float right) {
  struct Figure {
    std::string text;
    std::string widest;  // keeps the next one from moving with every digit
    Colour colour;
  };
  const Figure figures[] = {
      {formatted("t = %.2f", snapshot.time), "t = 0000.00", theme::kText},
      {formatted("T = %#.3g", snapshot.temperature), "T = 0.0000", theme::kFaintText},
      {grouped(snapshot.collisions) + " collisions", "", theme::kFaintText},
  };
  const float unit = fonts.unit();
  float x = std::round(kEdge * unit);
  const float y = size.height - x - unit;
  for (const Figure& figure : figures) {
    const float width = text_extent(*fonts.text, figure.text).x;
    if (x + width > right - unit) return;
    draw_text(list, *fonts.text, ImVec2(x, y), figure.colour, figure.text);
    x += std::round(std::max(width, text_extent(*fonts.text, figure.widest).x) + 1.5f * unit);
  }
}

// One below the other at the right of the box, or at the picture's edge where the box goes beyond.
void draw_legends(ImDrawList& list, std::span<const Legend> legends, const Vec2& box,
                  const Projection& projection, const Margins& margins, const Fonts& fonts) {
  if (legends.empty()) return;
  const float unit = fonts.unit();
  const double height = projection.size.height;
  const double top = std::max(margins.top, height - projection.pixels(box).y());
  const double bottom = std::min(height - margins.bottom, height - projection.pixels({0, 0}).y());
  const double beside_box = projection.pixels(box).x() + wall_thickness(projection.size) + unit;
  const float x = std::round(std::min(
      beside_box, projection.size.width - margins.right + wall_thickness(projection.size) + unit));

  const float gap = 1.5f * unit;
  const float each =
      std::min(18.0f * unit, static_cast<float>(bottom - top + gap) / legends.size() - gap);
  float y = std::round(top);
  for (const Legend& legend : legends) {
    draw_legend(list, legend, fonts, ImVec2(x, y), each);
    y = std::round(y + each + gap);
  }
}

}  // namespace

Overlay::Overlay(const Gl& gl) : gui_(gl) {
  const CurrentContext restored(ImGui::GetCurrentContext());
  context_.reset(ImGui::CreateContext());
  ImGui::SetCurrentContext(context_.get());
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

Fonts Overlay::fonts_for(Size size) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (unit_for(size) == loaded_size_) return loaded_fonts(atlas);
  atlas.Clear();
  loaded_size_ = unit_for(size);
  const Fonts fonts = add_fonts(atlas, loaded_size_);
  gui_.upload(atlas);
  return fonts;
}

Margins Overlay::margins(Size size, std::span<const Legend> legends, const OverlayText& text) {
  const CurrentContext current(context_.get());
  const Fonts fonts = fonts_for(size);
  const double unit = fonts.unit(), edge = std::round(kEdge * unit);
  const double wall = wall_thickness(size);

  double legend = 0.0;
  for (const Legend& each : legends) {
    legend = std::max<double>(legend, unit + legend_width(each, fonts));
  }
  const double heading = heading_of(text, size, fonts).end;
  return {edge + wall, edge + wall + legend, (heading > edge ? heading + unit : edge) + wall,
          edge + 2.0 * unit + wall};
}

void Overlay::draw(const Snapshot& snapshot, const Projection& projection,
                   std::span<const Legend> legends, const OverlayText& text) {
  const Margins room = margins(projection.size, legends, text);
  const CurrentContext current(context_.get());
  const Fonts fonts = fonts_for(projection.size);
  ImGui::GetIO().DisplaySize = ImVec2(projection.size.width, projection.size.height);
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  draw_heading(list, text, projection.size, fonts);
  draw_legends(list, legends, snapshot.box, projection, room, fonts);
  const float left = draw_scale_bar(list, snapshot.diameter, projection, fonts);
  draw_figures(list, snapshot, projection.size, fonts, left);
  ImGui::Render();
  gui_.draw(*ImGui::GetDrawData());
}

}  // namespace clatter
