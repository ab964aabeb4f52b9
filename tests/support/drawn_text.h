#pragma once

#include <imgui.h>

#include <cmath>
#include <string>
#include <vector>

namespace clatter::testing {

/// A text in a draw list, recovered from the texture coordinates of its letters.
struct DrawnText {
  std::string text;
  float left = 0.0f, top = 0.0f, right = 0.0f, bottom = 0.0f;  ///< rectangle of its letters
  ImU32 colour = 0;

  float middle_x() const { return 0.5f * (left + right); }
  float middle_y() const { return 0.5f * (top + bottom); }
};

inline void append_utf8(std::string& text, unsigned letter) {
  if (letter < 0x80) {
    text += static_cast<char>(letter);
  } else if (letter < 0x800) {
    text += static_cast<char>(0xc0 | (letter >> 6));
    text += static_cast<char>(0x80 | (letter & 0x3f));
  } else {
    text += static_cast<char>(0xe0 | (letter >> 12));
    text += static_cast<char>(0x80 | ((letter >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (letter & 0x3f));
  }
}

/// The letters of a font. From version 1.92 on, Dear ImGui keeps them for each size.
inline const ImVector<ImFontGlyph>& glyphs_of(ImFont& font) {
#if IMGUI_VERSION_NUM < 19200
  return font.Glyphs;
#else
  return font.GetFontBaked(font.LegacySize)->Glyphs;
#endif
}

/// The texts of a draw list in drawing order. Consecutive letters in a line form one text. Gaps are
/// spaces.
inline std::vector<DrawnText> texts_in(const ImDrawList& list) {
  struct Letter {
    const ImFontGlyph* glyph = nullptr;
    float scale = 1.0f;
  };
  const auto letter_at = [](const ImDrawVert* corner) {
    for (ImFont* font : ImGui::GetIO().Fonts->Fonts) {
      for (const ImFontGlyph& glyph : glyphs_of(*font)) {
        const bool same = std::fabs(glyph.U0 - corner[0].uv.x) < 1e-6f &&
                          std::fabs(glyph.V0 - corner[0].uv.y) < 1e-6f &&
                          std::fabs(glyph.U1 - corner[2].uv.x) < 1e-6f &&
                          std::fabs(glyph.V1 - corner[2].uv.y) < 1e-6f;
        if (!same || !glyph.Visible) continue;
        return Letter{&glyph, (corner[2].pos.x - corner[0].pos.x) / (glyph.X1 - glyph.X0)};
      }
    }
    return Letter{};
  };
  std::vector<DrawnText> texts;
  float next = 0.0f, baseline = 0.0f;  // position of the next letter
  for (int k = 0; k + 3 < list.VtxBuffer.Size;) {
    const ImDrawVert* corner = &list.VtxBuffer[k];
    const Letter letter = letter_at(corner);
    if (!letter.glyph) {
      ++k;
      next = -1e9f;
      continue;
    }
    const float pen = corner[0].pos.x - letter.scale * letter.glyph->X0;
    const float line = corner[0].pos.y - letter.scale * letter.glyph->Y0;
    const float gap = pen - next;
    const bool goes_on = !texts.empty() && std::fabs(line - baseline) < 0.5f && gap > -1.5f &&
                         gap < 8.0f * letter.scale && texts.back().colour == corner[0].col;
    if (!goes_on) {
      texts.push_back({"", corner[0].pos.x, corner[0].pos.y, 0.0f, 0.0f, corner[0].col});
    } else if (gap > 1.5f) {
      texts.back().text += ' ';
    }
    DrawnText& text = texts.back();
    append_utf8(text.text, letter.glyph->Codepoint);
    text.top = std::min(text.top, corner[0].pos.y);
    text.right = corner[2].pos.x;
    text.bottom = std::max(text.bottom, corner[2].pos.y);
    next = pen + letter.scale * letter.glyph->AdvanceX;
    baseline = line;
    k += 4;
  }
  return texts;
}

}  // namespace clatter::testing
