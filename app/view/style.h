#pragma once

#include "render/layers/fonts.h"

namespace clatter {

/// How the panels look at a text size in pixels: calm, dark, everything in proportion to the text.
void apply_style(float text_size);

/// The colour of what is active: sliders' grips, what is switched on.
Colour accent_colour();

}  // namespace clatter
