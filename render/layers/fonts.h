#pragma once

#include <imgui.h>

#include <string>

#include "render/theme.h"

namespace clatter {

/// One typeface in the sizes that the overlay uses, in pixels.
struct Fonts {
  const ImFont* card = nullptr;  ///< of the letters of one title only
  const ImFont* title = nullptr;
  const ImFont* text = nullptr;
  const ImFont* small = nullptr;

  /// The unit of the overlay's layout: the height of a line of text.
  float unit() const { return text->FontSize; }
};

/// The embedded typeface at text size `unit`, put into an empty atlas; for cards the letters of
/// `title`.
Fonts add_fonts(ImFontAtlas& atlas, float unit, const std::string& title = "");

/// The fonts that add_fonts put into `atlas`.
Fonts loaded_fonts(const ImFontAtlas& atlas);

/// The extent of a text, broken into lines at `wrap` pixels; 0: not broken.
ImVec2 text_extent(const ImFont& font, const std::string& text, float wrap = 0.0f);

/// Dear ImGui's form of a colour.
ImU32 packed(Colour colour);

/// Writes a text with its upper left corner at `place`, broken into lines at `wrap` pixels.
void draw_text(ImDrawList& list, const ImFont& font, ImVec2 place, const Ink& ink,
               const std::string& text, float wrap = 0.0f);

}  // namespace clatter
