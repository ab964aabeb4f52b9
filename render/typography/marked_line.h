#pragma once

#include <string>
#include <vector>

#include "render/typography/fonts.h"

namespace clatter {

/// A line of a text with sub- and superscripts, laid out.
struct MarkedLine {
  /// Letters of one font, with their upper left corner relative to that of the line, in pixels.
  struct Piece {
    std::string letters;
    Font font;
    ImVec2 place = {};
  };
  std::vector<Piece> pieces;
  float width = 0.0f;   ///< in pixels
  float height = 0.0f;  ///< in pixels, with room for scripts
};

/// Lays out a text, see marked_text(), with the script in a smaller font. Lines end at line breaks,
/// and between words where they would become longer than `wrap` pixels.
std::vector<MarkedLine> marked_lines(const std::string& text, const Font& font, const Font& script,
                                     float wrap);

/// Draws a line with its upper left corner at `place`.
void draw_marked(ImDrawList& list, const MarkedLine& line, ImVec2 place, const Ink& ink);

}  // namespace clatter
