#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "render/theme.h"

namespace clatter {

/// One typeface in the sizes of the overlay.
struct Fonts {
  const ImFont* card = nullptr;  ///< contains only the letters of one title
  const ImFont* title = nullptr;
  const ImFont* text = nullptr;
  const ImFont* small = nullptr;

  /// Unit of the layout: the height of a text line in pixels.
  float unit() const { return text->FontSize; }
};

/// Adds the embedded typeface to an empty atlas, with text size `unit` in pixels. The card font
/// contains the letters of `title`.
Fonts add_fonts(ImFontAtlas& atlas, float unit, const std::string& title = "");

/// The fonts that add_fonts() added to `atlas`.
Fonts loaded_fonts(const ImFontAtlas& atlas);

/// Adds the letters of a text in the embedded typeface to an empty atlas, once for each size in
/// pixels per em, and builds the atlas. The fonts are in the order of the sizes.
void add_letters(ImFontAtlas& atlas, const std::string& text, std::span<const double> sizes);

/// Size of a text in pixels, with lines broken at `wrap` pixels; 0: not broken.
ImVec2 text_extent(const ImFont& font, const std::string& text, float wrap = 0.0f);

/// A colour in the format of Dear ImGui.
ImU32 packed(Colour colour);

/// Draws a text with its upper left corner at `place` and lines broken at `wrap` pixels; 0: not
/// broken.
void draw_text(ImDrawList& list, const ImFont& font, ImVec2 place, const Ink& ink,
               const std::string& text, float wrap = 0.0f);

}  // namespace clatter
