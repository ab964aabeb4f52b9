#include "render/layers/legend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/colour_range.h"
#include "render/theme.h"

namespace clatter {

namespace {

constexpr float kBarWidth = 0.75f;    // of the bar, in units of the layout
constexpr float kTickLength = 0.25f;  // likewise
constexpr float kNameHeight = 1.15f;  // from the name's top to the unit's, likewise
constexpr float kHeadHeight = 2.75f;  // from the name's top to the bar's, likewise

std::string unit_and_range(const Legend& legend, const char* range) {
  return legend.quantity.unit + " · " + range;
}

void draw_head(ImDrawList& list, const Legend& legend, const Fonts& fonts, ImVec2 place) {
  const Quantity& quantity = legend.quantity;
  draw_text(list, *fonts.small, place, theme::kText, quantity.name);
  const ImVec2 subscript(place.x + text_extent(*fonts.small, quantity.name).x,
                         place.y + 0.3f * fonts.unit());
  list.AddText(fonts.small, std::round(0.75f * fonts.small->FontSize), subscript,
               packed(theme::kText), quantity.subscript.c_str());
  draw_text(list, *fonts.small, ImVec2(place.x, std::round(place.y + kNameHeight * fonts.unit())),
            theme::kFaintText, unit_and_range(legend, legend.range.c_str()));
}

// One strip of colour a pixel: the map's kinks must not depend on the bar's height.
void draw_bar(ImDrawList& list, const ColourScale& scale, ImVec2 low, ImVec2 high) {
  for (float y = low.y; y < high.y; ++y) {
    const double share = (high.y - y - 0.5f) / (high.y - low.y);
    const Colour colour = scale(scale.low + share * (scale.high - scale.low));
    list.AddRectFilled(ImVec2(low.x, y), ImVec2(high.x, y + 1.0f), packed(colour));
  }
}

}  // namespace

float legend_width(const Legend& legend, const Fonts& fonts) {
  const float name = text_extent(*fonts.small, legend.quantity.name).x +
                     0.75f * text_extent(*fonts.small, legend.quantity.subscript).x;
  // The longest of the ranges, so that a change of it moves nothing.
  const float unit = text_extent(*fonts.small, unit_and_range(legend, "locked")).x;
  const float ticks =
      (kBarWidth + 2.0f * kTickLength) * fonts.unit() + text_extent(*fonts.small, "−0.00").x;
  return std::ceil(std::max({name, unit, ticks}));
}

void draw_legend(ImDrawList& list, const Legend& legend, const Fonts& fonts, ImVec2 place,
                 float height) {
  const float unit = fonts.unit();
  const ImVec2 low(place.x, std::round(place.y + kHeadHeight * unit));
  const ImVec2 high(std::round(place.x + kBarWidth * unit), std::round(place.y + height));
  draw_head(list, legend, fonts, place);
  draw_bar(list, legend.scale, low, high);

  const int count = std::clamp(static_cast<int>((high.y - low.y) / (2.2f * unit)), 1, 5);
  const auto [least, most] = std::minmax(legend.scale.low, legend.scale.high);
  const auto ticks = round_ticks(least, most, count);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : most - least;
  for (double tick : ticks) {
    const double share = (tick - legend.scale.low) / (legend.scale.high - legend.scale.low);
    const float y = std::round(high.y - 1.0f - share * (high.y - low.y - 1.0f));
    list.AddRectFilled(ImVec2(high.x, y), ImVec2(high.x + kTickLength * unit, y + 1.0f),
                       packed(theme::kFaintText));
    draw_text(list, *fonts.small,
              ImVec2(std::round(high.x + 2.0f * kTickLength * unit),
                     std::round(y - 0.5f * fonts.small->FontSize)),
              theme::kFaintText, tick_text(tick, step));
  }
}

}  // namespace clatter
