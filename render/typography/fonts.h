#pragma once

#include <imgui.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/embedded_file.h"
#include "render/theme.h"

namespace clatter {

/// The fonts for text: DejaVuSans.ttf.
std::span<const EmbeddedFile> embedded_fonts();

/// Letters in one size.
struct Font {
  ImFont* face = nullptr;  ///< of an atlas, which owns it
  float size = 0.0f;       ///< height from the ascent to the descent, pixels
  /// The letters that the face has, for Dear ImGui, which may read them as long as the atlas lives.
  /// Absent: the usual ones.
  std::shared_ptr<const ImVector<ImWchar>> letters = {};

  /// Distance of the baseline from the upper edge of the letters, pixels. Dear ImGui rounds it to
  /// the next larger whole number.
  float ascent() const;

  bool operator==(const Font&) const = default;
};

/// One typeface in the sizes of the overlay.
struct Fonts {
  Font card;  ///< contains only the letters of one title
  Font title;
  Font text;
  Font small;

  /// Unit of the layout: the height of a text line in pixels.
  float unit() const { return text.size; }
};

/// Adds the embedded typeface to an empty atlas, with text size `unit` in pixels. The card font
/// contains the letters of `title`.
Fonts add_fonts(ImFontAtlas& atlas, float unit, const std::string& title = "");

/// Adds the letters of a text in the embedded typeface to an empty atlas, once for each size in
/// pixels per em, and builds the atlas. Returns the fonts in the order of the sizes.
std::vector<Font> add_letters(ImFontAtlas& atlas, const std::string& text,
                              std::span<const double> sizes);

/// Size of a text in pixels, with lines broken at `wrap` pixels; 0: not broken.
ImVec2 text_extent(const Font& font, const std::string& text, float wrap = 0.0f);

/// The lines of a text broken between words. `fits` tells whether a line is short enough. A longer
/// word has a line of its own.
std::vector<std::string> broken_lines(const std::string& text,
                                      const std::function<bool(const std::string&)>& fits);

/// A colour in the format of Dear ImGui.
ImU32 packed(Colour colour);

/// Draws a text with its upper left corner at `place` and lines broken at `wrap` pixels; 0: not
/// broken.
void draw_text(ImDrawList& list, const Font& font, ImVec2 place, const Ink& ink,
               const std::string& text, float wrap = 0.0f);

/// Measures texts of any size. All sizes of the typeface have the same proportions.
class TextWidths {
 public:
  /// Measures texts with these letters.
  explicit TextWidths(const std::string& letters);
  TextWidths(const TextWidths&) = delete;
  TextWidths& operator=(const TextWidths&) = delete;

  /// The width of a text of one line. `size` is in pixels per em.
  double operator()(const std::string& text, double size) const;

  /// The lines of a text broken at a width, in pixels. A longer word has a line of its own.
  std::vector<std::string> lines(const std::string& text, double size, double width) const;

 private:
  ImFontAtlas atlas_;
  Font font_;
};

}  // namespace clatter
