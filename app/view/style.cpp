#include "app/view/style.h"

#include <cmath>

#include "app/view/controls.h"

namespace clatter {

Colour accent_colour() {
  return {0x3d, 0x8f, 0xd6};
}

void TextScale::draw(Controls& controls) {
  controls.number({.key = "window.scale",
                   .name = "Size",
                   .help = "Of all texts and widgets of the window",
                   .low = 1.0,
                   .high = 3.0,
                   .format = "%.2f"},
                  wanted_, 1.0);
  if (!ImGui::IsMouseDown(0)) value_ = wanted_;
}

ThemeColours panel_theme(View view) {
  view.background.reset();
  return theme_of(view);
}

static ImVec4 shade(Colour colour, float alpha = 1.0f) {
  return {colour.red / 255.0f, colour.green / 255.0f, colour.blue / 255.0f, alpha};
}

static void apply_colours(ImVec4* colours, const ThemeColours& theme) {
  const Colour panel = mix(theme.background, theme.text, 0.05);
  const Colour field = mix(theme.background, theme.text, 0.11);
  const Colour hovered = mix(theme.background, theme.text, 0.17);
  const Colour line = mix(theme.background, theme.text, 0.13);
  colours[ImGuiCol_Text] = shade(theme.text);
  colours[ImGuiCol_TextDisabled] = shade(theme.faint_text);
  colours[ImGuiCol_WindowBg] = shade(panel);
  colours[ImGuiCol_ChildBg] = shade(panel, 0.0f);
  colours[ImGuiCol_PopupBg] = shade(mix(theme.background, theme.text, 0.08));
  colours[ImGuiCol_Border] = shade(line);
  colours[ImGuiCol_Separator] = shade(line);
  colours[ImGuiCol_FrameBg] = shade(field);
  colours[ImGuiCol_FrameBgHovered] = shade(hovered);
  colours[ImGuiCol_FrameBgActive] = shade(hovered);
  colours[ImGuiCol_Button] = shade(field);
  colours[ImGuiCol_ButtonHovered] = shade(hovered);
  colours[ImGuiCol_ButtonActive] = shade(accent_colour(), 0.6f);
  colours[ImGuiCol_Header] = shade(field);
  colours[ImGuiCol_HeaderHovered] = shade(hovered);
  colours[ImGuiCol_HeaderActive] = shade(hovered);
  colours[ImGuiCol_SliderGrab] = shade(accent_colour(), 0.85f);
  colours[ImGuiCol_SliderGrabActive] = shade(accent_colour());
  colours[ImGuiCol_CheckMark] = shade(accent_colour());
  colours[ImGuiCol_ScrollbarBg] = shade(panel, 0.0f);
  colours[ImGuiCol_ScrollbarGrab] = shade(field);
  colours[ImGuiCol_ScrollbarGrabHovered] = shade(hovered);
  colours[ImGuiCol_TextSelectedBg] = shade(accent_colour(), 0.4f);
  colours[ImGuiCol_NavHighlight] = shade(accent_colour());
  colours[ImGuiCol_ModalWindowDimBg] = shade(theme.background, 0.6f);
}

void apply_style(float text_size, float least_target, const ThemeColours& theme) {
  ImGuiStyle style;
  const float unit = text_size / 14.0f;
  style.WindowPadding = ImVec2(12, 10);
  style.FramePadding = ImVec2(6, 3);
  style.ItemSpacing = ImVec2(7, 5);
  style.ItemInnerSpacing = ImVec2(6, 4);
  style.ScrollbarSize = 8;
  style.GrabMinSize = 9;
  style.WindowRounding = 0;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 4;
  style.ScaleAllSizes(unit);
  if (const float room = 0.5f * (least_target - text_size); room > style.FramePadding.y) {
    style.FramePadding.y = std::round(room);
    style.ItemSpacing.y *= 1.8f;
    style.GrabMinSize *= 2.0f;
  }
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  apply_colours(style.Colors, theme);
  ImGui::GetStyle() = style;
}

}  // namespace clatter
