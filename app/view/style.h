#pragma once

#include <imgui.h>

#include "render/theme.h"

namespace clatter {

/// How the panels look at a text size in pixels: calm, in a theme's colours, everything in
/// proportion to the text.
void apply_style(float text_size, const ThemeColours& theme);

/// The colours of the view's theme, whatever background the picture has.
ThemeColours panel_theme(View view);

/// Of panels that stay where they are put.
inline constexpr ImGuiWindowFlags kFixedPanel =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus;

/// The colour of what is active, on any theme: sliders' grips, what is switched on.
Colour accent_colour();

}  // namespace clatter
