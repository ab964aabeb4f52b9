#pragma once

#include <imgui.h>

#include "render/theme.h"

namespace clatter {

class Controls;

/// Sets the style of the panels for a text size in pixels and a theme. All lengths scale with the
/// text size. Widgets are at least `least_target` pixels high; 0: usual height.
void apply_style(float text_size, float least_target, const ThemeColours& theme);

/// The scale of all texts and widgets of the window, which the user chooses.
class TextScale {
 public:
  /// Draws the slider. It acts when it is released, because it moves itself.
  void draw(Controls& controls);
  /// The scale, 1 at first.
  double value() const { return value_; }

 private:
  double wanted_ = 1.0;  // of the slider
  double value_ = 1.0;
};

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
