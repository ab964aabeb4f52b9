#include "render/typography/fonts.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <sstream>
#include <utility>

namespace clatter {

namespace {

// Lengths of DejaVu Sans in its own unit. Dear ImGui counts sizes from the ascent to the descent.
constexpr float kEm = 2048.0f, kAscent = 1901.0f, kHeight = 2384.0f;

// Latin, Greek, Cyrillic, punctuation, sub- and superscripts, arrows, mathematics.
constexpr ImWchar kGlyphs[] = {0x0020, 0x017f, 0x0370, 0x045f, 0x2009, 0x2027, 0x2070, 0x209c,
                               0x2190, 0x2199, 0x2200, 0x226b, 0x27e8, 0x27e9, 0};

// Settings of a size. Versions of Dear ImGui have different usual numbers of samples per pixel.
ImFontConfig sampled(float size) {
  constexpr float kLarge = 64.0f;  // a third of a pixel is invisible in larger letters
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = size < kLarge ? 3 : 1;
  config.OversampleV = 1;
  return config;
}

using Letters = std::shared_ptr<const ImVector<ImWchar>>;

// Adds the embedded typeface in one size. An atlas has all usual letters in sizes up to `kLargest`.
// Larger ones are enlarged.
Font add_size(ImFontAtlas& atlas, float size, const Letters& letters = {}) {
  constexpr float kLargest = 160.0f;
  const float drawn = letters ? size : std::min(size, kLargest);
  const std::string_view file = embedded_fonts().front().bytes;
  const ImFontConfig config = sampled(drawn);
  // The atlas requires a mutable pointer, but does not change the bytes.
  return {atlas.AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()),
                                     drawn, &config, letters ? letters->Data : kGlyphs),
          size, letters};
}

Letters letters_of(const std::string& text) {
  ImFontGlyphRangesBuilder letters;
  letters.AddText(text.data(), text.data() + text.size());
  const auto ranges = std::make_shared<ImVector<ImWchar>>();
  letters.BuildRanges(ranges.get());
  return ranges;
}

}  // namespace

float Font::ascent() const {
  return std::floor(kAscent / kHeight * size + 1.0f);
}

Fonts add_fonts(ImFontAtlas& atlas, float unit, const std::string& title) {
  Fonts fonts;
  fonts.title = add_size(atlas, std::round(1.5f * unit));
  fonts.text = add_size(atlas, unit);
  fonts.small = add_size(atlas, std::round(0.85f * unit));
  fonts.card = add_size(atlas, std::round(3.0f * unit), letters_of(title + ' '));
  atlas.Build();
  return fonts;
}

std::vector<Font> add_letters(ImFontAtlas& atlas, const std::string& text,
                              std::span<const double> sizes) {
  const Letters letters = letters_of(text + "? ");  // ? replaces letters that it lacks
  std::vector<Font> fonts;
  for (const double size : sizes) {
    fonts.push_back(add_size(atlas, static_cast<float>(kHeight / kEm * size), letters));
  }
  atlas.Build();
  return fonts;
}

ImVec2 text_extent(const Font& font, const std::string& text, float wrap) {
  return font.face->CalcTextSizeA(font.size, FLT_MAX, wrap, text.data(), text.data() + text.size());
}

std::vector<std::string> broken_lines(const std::string& text,
                                      const std::function<bool(const std::string&)>& fits) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + ' ' + word;
    if (!lines.empty() && fits(longer)) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

ImU32 packed(Colour colour) {
  return IM_COL32(colour.red, colour.green, colour.blue, colour.alpha);
}

void draw_text(ImDrawList& list, const Font& font, ImVec2 place, const Ink& ink,
               const std::string& text, float wrap) {
  auto write = [&](float dx, float dy, ImU32 colour) {
    list.AddText(font.face, font.size, ImVec2(place.x + dx, place.y + dy), colour, text.data(),
                 text.data() + text.size(), wrap);
  };
  // A halo in the background colour keeps the text legible above disks.
  constexpr int kHalo = 120;  // alpha below opaque letters
  const ImU32 halo =
      IM_COL32(ink.halo.red, ink.halo.green, ink.halo.blue, kHalo * ink.colour.alpha / 255);
  for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) write(dx, dy, halo);
  write(0, 0, packed(ink.colour));
}

static constexpr double kMeasured = 32.0;  // size, pixels per em

TextWidths::TextWidths(const std::string& letters)
    : font_(add_letters(atlas_, letters, std::array{kMeasured}).front()) {}

double TextWidths::operator()(const std::string& text, double size) const {
  return text_extent(font_, text).x * size / kMeasured;
}

std::vector<std::string> TextWidths::lines(const std::string& text, double size,
                                           double width) const {
  return broken_lines(text, [&](const std::string& line) { return (*this)(line, size) <= width; });
}

}  // namespace clatter
