#include "render/typography/marked_line.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/marked_text.h"

namespace clatter {

namespace {

// Offsets of the baselines of scripts, in sizes of the font.
constexpr float kLowered = 0.16f, kRaised = 0.34f;
// Height of a line, in sizes of the font.
constexpr float kLineHeight = 1.3f;

// Collects words into lines.
class LineBreaker {
 public:
  LineBreaker(const Font& font, const Font& script, float wrap)
      : font_(font), script_(script), wrap_(wrap) {}

  // Adds letters without blanks to the current word.
  void add(const std::string& letters, TextRun::Script script) {
    if (letters.empty()) return;
    const Font& font = script == TextRun::Base ? font_ : script_;
    // A subscript and a superscript beside each other share their place.
    const bool shares = script != TextRun::Base && last_ != TextRun::Base && last_ != script;
    const float start = shares ? script_start_ : word_width_;
    const float baseline = 0.5f * (kLineHeight - 1.0f) * font_.size + font_.ascent() +
                           font_.size * (script == TextRun::Below   ? kLowered
                                         : script == TextRun::Above ? -kRaised
                                                                    : 0.0f);
    word_.push_back({letters, font, ImVec2(start, std::round(baseline - font.ascent()))});
    script_start_ = start;
    last_ = shares ? TextRun::Base : script;
    word_width_ = std::max(word_width_, start + std::ceil(text_extent(font, letters).x));
  }

  // Ends the current word, before a blank.
  void end_word() {
    MarkedLine& line = lines_.back();
    if (line.width > 0.0f && line.width + blanks_ + word_width_ > wrap_) {
      end_line();
      return end_word();
    }
    const float start = line.width > 0.0f ? line.width + blanks_ : 0.0f;
    for (MarkedLine::Piece& piece : word_) {
      piece.place.x += start;
      line.pieces.push_back(std::move(piece));
    }
    if (!word_.empty()) {
      line.width = start + word_width_;
      blanks_ = 0.0f;
    }
    word_.clear();
    word_width_ = 0.0f;
    last_ = TextRun::Base;
  }

  void add_blank() { blanks_ += std::round(text_extent(font_, " ").x); }

  // Begins the next line. The current word goes there.
  void end_line() {
    lines_.push_back(empty_line());
    blanks_ = 0.0f;
  }

  std::vector<MarkedLine> take() { return std::move(lines_); }

 private:
  MarkedLine empty_line() const {
    return {.pieces = {}, .width = 0.0f, .height = std::round(kLineHeight * font_.size)};
  }

  const Font& font_;
  const Font& script_;
  float wrap_;
  std::vector<MarkedLine> lines_ = {empty_line()};
  float blanks_ = 0.0f;  // width of the blanks at the end of the last line
  std::vector<MarkedLine::Piece> word_;
  float word_width_ = 0.0f;
  float script_start_ = 0.0f;             // of the last script
  TextRun::Script last_ = TextRun::Base;  // Base also after two scripts that share a place
};

}  // namespace

std::vector<MarkedLine> marked_lines(const std::string& text, const Font& font, const Font& script,
                                     float wrap) {
  LineBreaker breaker(font, script, wrap);
  for (const TextRun& run : marked_text(text).runs) {
    std::size_t from = 0;
    while (run.script == TextRun::Base) {
      const std::size_t end = run.letters.find_first_of(" \n", from);
      breaker.add(run.letters.substr(from, end - from), TextRun::Base);
      if (end == std::string::npos) break;
      breaker.end_word();
      if (run.letters[end] == '\n') {
        breaker.end_line();
      } else {
        breaker.add_blank();
      }
      from = end + 1;
    }
    if (run.script != TextRun::Base) breaker.add(run.letters, run.script);
  }
  breaker.end_word();
  return breaker.take();
}

void draw_marked(ImDrawList& list, const MarkedLine& line, ImVec2 place, const Ink& ink) {
  for (const MarkedLine::Piece& piece : line.pieces) {
    draw_text(list, piece.font, ImVec2(place.x + piece.place.x, place.y + piece.place.y), ink,
              piece.letters);
  }
}

}  // namespace clatter
