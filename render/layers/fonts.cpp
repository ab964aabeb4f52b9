#include "render/layers/fonts.h"

#include <cfloat>
#include <cmath>
#include <utility>

#include "render/gl/embedded_files.h"

namespace clatter {

namespace {

// Latin, Greek, Cyrillic, punctuation, sub- and superscripts, arrows, mathematics.
constexpr ImWchar kGlyphs[] = {0x0020, 0x017f, 0x0370, 0x045f, 0x2009, 0x2027, 0x2070, 0x209c,
                               0x2190, 0x2199, 0x2200, 0x226b, 0x27e8, 0x27e9, 0};

}  // namespace

Fonts add_fonts(ImFontAtlas& atlas, float unit, const std::string& title) {
  const std::string_view file = embedded_fonts().front().bytes;
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  for (float size : {std::round(1.5f * unit), unit, std::round(0.85f * unit)}) {
    // The atlas requires a mutable pointer, but does not change the bytes.
    atlas.AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()), size,
                               &config, kGlyphs);
  }
  // All glyphs in a large size would need a very large atlas. The ranges must live until Build().
  ImFontGlyphRangesBuilder letters;
  letters.AddText(title.c_str());
  letters.AddText(" ");
  ImVector<ImWchar> ranges;
  letters.BuildRanges(&ranges);
  atlas.AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()),
                             std::round(3.0f * unit), &config, ranges.Data);
  atlas.Build();
  return loaded_fonts(atlas);
}

void add_letters(ImFontAtlas& atlas, const std::string& text, std::span<const double> sizes) {
  // Dear ImGui counts sizes from the ascent to the descent, which are 2384 / 2048 em of DejaVu
  // Sans.
  constexpr double kLineHeight = 2384.0 / 2048.0;
  const std::string_view file = embedded_fonts().front().bytes;
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  ImFontGlyphRangesBuilder letters;
  letters.AddText(text.data(), text.data() + text.size());
  letters.AddText("? ");  // the first replaces letters that the typeface lacks
  ImVector<ImWchar> ranges;
  letters.BuildRanges(&ranges);
  for (const double size : sizes) {
    atlas.AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()),
                               static_cast<float>(kLineHeight * size), &config, ranges.Data);
  }
  atlas.Build();
}

Fonts loaded_fonts(const ImFontAtlas& atlas) {
  return {atlas.Fonts[3], atlas.Fonts[0], atlas.Fonts[1], atlas.Fonts[2]};
}

ImVec2 text_extent(const ImFont& font, const std::string& text, float wrap) {
  return font.CalcTextSizeA(font.FontSize, FLT_MAX, wrap, text.data(), text.data() + text.size());
}

ImU32 packed(Colour colour) {
  return IM_COL32(colour.red, colour.green, colour.blue, colour.alpha);
}

void draw_text(ImDrawList& list, const ImFont& font, ImVec2 place, const Ink& ink,
               const std::string& text, float wrap) {
  auto write = [&](float dx, float dy, ImU32 colour) {
    list.AddText(&font, font.FontSize, ImVec2(place.x + dx, place.y + dy), colour, text.data(),
                 text.data() + text.size(), wrap);
  };
  // A halo in the background colour keeps the text legible above disks.
  constexpr int kHalo = 120;  // alpha below opaque letters
  const ImU32 halo =
      IM_COL32(ink.halo.red, ink.halo.green, ink.halo.blue, kHalo * ink.colour.alpha / 255);
  for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) write(dx, dy, halo);
  write(0, 0, packed(ink.colour));
}

}  // namespace clatter
