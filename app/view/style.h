#pragma once

#include <imgui.h>

#include "render/theme.h"

namespace clatter {

/// Sets the style of the panels for a text size in pixels and a theme. All lengths scale with the
/// text size. Widgets are at least `least_target` pixels high; 0: usual height.
void apply_style(float text_size, float least_target, const ThemeColours& theme);

/// The colours of the view's theme, without the background colour of the view.
ThemeColours panel_theme(View view);

/// The right end of the lines of the current window, from its left edge.
inline float right_edge() {
  return ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
}

/// Flags of panels at a fixed position.
inline constexpr ImGuiWindowFlags kFixedPanel =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus;

/// The colour of active widgets in all themes, such as slider grips and check marks.
Colour accent_colour();

}  // namespace clatter
