#pragma once

#include <string>

#include "render/layers/fonts.h"
#include "render/palette.h"
#include "render/quantity.h"

namespace clatter {

/// What a colour means.
struct Legend {
  Quantity quantity;
  ColourScale scale;
  std::string range;  ///< where the scale's ends come from: "auto", "locked" or "given"
};

/// The width that a legend takes, in pixels.
float legend_width(const Legend& legend, const Fonts& fonts);

/// Draws the legend as a vertical bar, with name, unit and range above, `height` pixels high in
/// all.
void draw_legend(ImDrawList& list, const Legend& legend, const Fonts& fonts, ImVec2 place,
                 float height);

}  // namespace clatter
