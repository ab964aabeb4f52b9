#pragma once

#include <string>

#include "render/layers/fonts.h"
#include "render/palette.h"

namespace clatter {

/// What a colour means.
struct Legend {
  std::string name;       ///< of the quantity, ends with its symbol: "velocity v"
  std::string subscript;  ///< of that symbol, e.g. "x"; may be empty
  ColourScale scale;
};

/// The width that a legend takes, in pixels.
float legend_width(const Legend& legend, const Fonts& fonts);

/// Draws the legend as a vertical bar, its name above, `height` pixels high in all.
void draw_legend(ImDrawList& list, const Legend& legend, const Fonts& fonts, ImVec2 place,
                 float height);

}  // namespace clatter
