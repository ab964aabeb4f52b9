#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/label.h"
#include "render/layers/arrow_layer.h"
#include "render/layers/fonts.h"
#include "render/palette.h"

namespace clatter {

/// What a colour means.
struct Legend {
  Label label;
  ColourScale scale;
  std::string range;  ///< where the scale's ends come from: "auto", "locked" or "given"
};

/// What the length of an arrow means.
struct ArrowLegend {
  Label label;
  double pixels = 1.0;  ///< length per unit of value
};

/// All that stands beside a picture to say what it shows.
struct Legends {
  std::optional<Legend> disks, field;
  std::optional<ArrowLegend> arrows;

  /// Those that there are of colours, from the top.
  std::vector<Legend> bars() const;
};

/// The width that the widest of them takes, in pixels; 0 where there is none.
float legend_width(const Legends& legends, const Fonts& fonts);

/// Draws the legend as a vertical bar, with name, unit and range above, `height` pixels high in
/// all.
void draw_legend(ImDrawList& list, const Legend& legend, const Fonts& fonts,
                 const ThemeColours& theme, ImVec2 place, float height);

/// The height that the legend of arrows takes, in pixels.
float arrow_legend_height(const Fonts& fonts);

/// Draws the legend as a name, an arrow of `shape` and the round value that it stands for.
void draw_arrow_legend(ImDrawList& list, const ArrowLegend& legend, const Fonts& fonts,
                       const ThemeColours& theme, const ArrowShape& shape, ImVec2 place);

}  // namespace clatter
