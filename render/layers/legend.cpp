#include "render/layers/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "render/colour_range.h"

namespace clatter {

namespace {

// Lengths in units of the layout, see Fonts::unit().
constexpr float kBarWidth = 0.75f;
constexpr float kTickLength = 0.25f;
constexpr float kNameHeight = 1.15f;  // from the top of the name to the top of the unit
constexpr float kHeadHeight = 2.75f;  // from the top of the name to the top of the bar
constexpr float kArrowHeight = 2.0f;  // from the top of the name to the middle of the arrow
constexpr float kLongestArrow = 5.0f;
constexpr float kSpeciesHead = 1.6f;     // from the top of the heading to that of the first species
constexpr float kSpeciesHeight = 2.6f;   // from one species to the next
constexpr float kLargestSpecies = 1.6f;  // diameter of the largest disk
constexpr float kLeastSpecies = 0.2f;    // diameter of a disk at least
constexpr float kLongestName = 8.0f;     // of a species

std::string unit_and_range(const Legend& legend, const char* range) {
  const std::string& unit = legend.label.unit;
  return (unit.empty() ? "" : unit + " · ") + range;
}

void draw_name(ImDrawList& list, const Label& label, const Fonts& fonts, const ThemeColours& theme,
               ImVec2 place) {
  draw_text(list, fonts.small, place, theme.ink(), label.name);
  const ImVec2 subscript(place.x + text_extent(fonts.small, label.name).x,
                         place.y + 0.3f * fonts.unit());
  list.AddText(fonts.small.face, std::round(0.75f * fonts.small.size), subscript,
               packed(theme.text), label.subscript.c_str());
}

float name_width(const Label& label, const Fonts& fonts) {
  return text_extent(fonts.small, label.name).x +
         0.75f * text_extent(fonts.small, label.subscript).x;
}

// One strip per pixel row, so that the colours of the map do not depend on the height of the bar.
// The frame keeps colours visible that equal the background.
void draw_bar(ImDrawList& list, const ColourScale& scale, Colour frame, ImVec2 low, ImVec2 high) {
  for (float y = low.y; y < high.y; ++y) {
    const double share = (high.y - y - 0.5f) / (high.y - low.y);
    const Colour colour = scale(scale.low + share * (scale.high - scale.low));
    list.AddRectFilled(ImVec2(low.x, y), ImVec2(high.x, y + 1.0f), packed(colour));
  }
  list.AddRect(ImVec2(low.x - 1.0f, low.y - 1.0f), ImVec2(high.x + 1.0f, high.y + 1.0f),
               packed(frame));
}

float bar_width(const Legend& legend, const Fonts& fonts) {
  // The longest range word, so that the layout does not depend on the range.
  const float unit = text_extent(fonts.small, unit_and_range(legend, "locked")).x;
  const float ticks =
      (kBarWidth + 2.0f * kTickLength) * fonts.unit() + text_extent(fonts.small, "−0.00").x;
  return std::max({name_width(legend.label, fonts), unit, ticks});
}

float arrow_width(const ArrowLegend& legend, const Fonts& fonts) {
  const float value = text_extent(fonts.small, "0.005 " + legend.label.unit).x;
  return std::max({name_width(legend.label, fonts), value, kLongestArrow * fonts.unit()});
}

// A name without its end if it is longer than the legend.
std::string shown_name(const std::string& name, const Fonts& fonts) {
  const float longest = kLongestName * fonts.unit();
  if (text_extent(fonts.small, name).x <= longest) return name;
  std::string cut = name;
  while (text_extent(fonts.small, cut + "…").x > longest) cut.pop_back();
  return cut + "…";
}

std::string diameters_of(const Species& species) {
  const auto text = [](double diameter) {
    std::array<char, 32> digits;
    std::snprintf(digits.data(), digits.size(), "%.3g", diameter);
    return std::string(digits.data());
  };
  std::string range = "d = " + text(species.smallest_diameter());
  if (species.polydispersity) range += "–" + text(species.largest_diameter());
  return range + " a";
}

// From the left edge of the legend to the names of the species.
float species_indent(const Fonts& fonts) {
  return std::round((kLargestSpecies + 0.5f) * fonts.unit());
}

float species_width(const SpeciesLegend& legend, const Fonts& fonts) {
  float width = text_extent(fonts.small, "species").x;
  for (const Species& species : legend.species) {
    for (const std::string& text : {shown_name(species.name, fonts), diameters_of(species)}) {
      width = std::max(width, species_indent(fonts) + text_extent(fonts.small, text).x);
    }
  }
  return width;
}

}  // namespace

std::vector<Legend> Legends::bars() const {
  std::vector<Legend> list;
  for (const auto& legend : {disks, field}) {
    if (legend) list.push_back(*legend);
  }
  return list;
}

float legend_width(const Legends& legends, const Fonts& fonts) {
  float width = legends.arrows ? arrow_width(*legends.arrows, fonts) : 0.0f;
  if (legends.species) width = std::max(width, species_width(*legends.species, fonts));
  for (const Legend& legend : legends.bars()) width = std::max(width, bar_width(legend, fonts));
  return std::ceil(width);
}

std::pair<ImVec2, ImVec2> legend_bar(const Fonts& fonts, ImVec2 place, float height) {
  const float unit = fonts.unit();
  return {{place.x, std::round(place.y + kHeadHeight * unit)},
          {std::round(place.x + kBarWidth * unit), std::round(place.y + height)}};
}

void draw_legend(ImDrawList& list, const Legend& legend, const Fonts& fonts,
                 const ThemeColours& theme, ImVec2 place, float height) {
  const float unit = fonts.unit();
  const auto [low, high] = legend_bar(fonts, place, height);
  draw_name(list, legend.label, fonts, theme, place);
  draw_text(list, fonts.small, ImVec2(place.x, std::round(place.y + kNameHeight * unit)),
            theme.faint_ink(), unit_and_range(legend, legend.range.c_str()));
  draw_bar(list, legend.scale, theme.static_wall, low, high);

  const int count = std::clamp(static_cast<int>((high.y - low.y) / (2.2f * unit)), 1, 5);
  const auto [least, most] = std::minmax(legend.scale.low, legend.scale.high);
  const auto ticks = round_ticks(least, most, count);
  const double step = ticks[1] - ticks[0];
  for (double tick : ticks) {
    const double share = (tick - legend.scale.low) / (legend.scale.high - legend.scale.low);
    const float y = std::round(high.y - 1.0f - share * (high.y - low.y - 1.0f));
    list.AddRectFilled(ImVec2(high.x, y), ImVec2(high.x + kTickLength * unit, y + 1.0f),
                       packed(theme.faint_text));
    draw_text(list, fonts.small,
              ImVec2(std::round(high.x + 2.0f * kTickLength * unit),
                     std::round(y - 0.5f * fonts.small.size)),
              theme.faint_ink(), tick_text(tick, step));
  }
}

float species_legend_height(const SpeciesLegend& legend, const Fonts& fonts) {
  const auto count = static_cast<float>(legend.species.size());
  return std::ceil((kSpeciesHead + count * kSpeciesHeight) * fonts.unit());
}

SpeciesLegend fitting(SpeciesLegend legend, const Fonts& fonts, float height) {
  while (legend.species.size() > 1 && species_legend_height(legend, fonts) > height) {
    legend.species.pop_back();
    legend.colours.pop_back();
  }
  return legend;
}

void draw_species_legend(ImDrawList& list, const SpeciesLegend& legend, const Fonts& fonts,
                         const ThemeColours& theme, ImVec2 place) {
  const float unit = fonts.unit();
  draw_text(list, fonts.small, place, theme.ink(), "species");
  double largest = 0.0;
  for (const Species& species : legend.species) largest = std::max(largest, species.diameter);
  float y = place.y + kSpeciesHead * unit;
  const float x = place.x + species_indent(fonts);
  for (std::size_t k = 0; k < legend.species.size(); ++k, y += kSpeciesHeight * unit) {
    const Species& species = legend.species[k];
    const auto share = static_cast<float>(species.diameter / largest);
    const float radius = 0.5f * unit * std::max(share * kLargestSpecies, kLeastSpecies);
    const ImVec2 middle(place.x + 0.5f * kLargestSpecies * unit,
                        y + 0.5f * kNameHeight * unit + 0.5f * fonts.small.size);
    list.AddCircleFilled(middle, radius, packed(legend.colours[k]), 48);
    // Keeps a colour visible that equals the background.
    list.AddCircle(middle, radius, packed(theme.static_wall), 48);
    draw_text(list, fonts.small, ImVec2(x, std::round(y)), theme.ink(),
              shown_name(species.name, fonts));
    draw_text(list, fonts.small, ImVec2(x, std::round(y + kNameHeight * unit)), theme.faint_ink(),
              diameters_of(species));
  }
}

float arrow_legend_height(const Fonts& fonts) {
  return std::ceil((kArrowHeight + 0.75f) * fonts.unit() + fonts.small.size);
}

void draw_arrow_legend(ImDrawList& list, const ArrowLegend& legend, const Fonts& fonts,
                       const ThemeColours& theme, const ArrowShape& shape, ImVec2 place) {
  const float unit = fonts.unit();
  draw_name(list, legend.label, fonts, theme, place);
  const double value = round_down(kLongestArrow * unit / legend.pixels);
  const float y = std::round(place.y + kArrowHeight * unit);
  const float tip = place.x + static_cast<float>(value * legend.pixels);
  const float shaft = static_cast<float>(shape.shaft), width = static_cast<float>(shape.head_width);
  const float neck = tip - static_cast<float>(shape.head_length);
  list.AddRectFilled(ImVec2(place.x, y - shaft), ImVec2(neck, y + shaft), packed(theme.text));
  list.AddTriangleFilled(ImVec2(neck, y - width), ImVec2(tip, y), ImVec2(neck, y + width),
                         packed(theme.text));
  draw_text(list, fonts.small, ImVec2(place.x, std::round(y + 0.6f * unit)), theme.faint_ink(),
            tick_text(value, value) + " " + legend.label.unit);
}

}  // namespace clatter
