#include <doctest/doctest.h>

#include "render/typography/marked_line.h"

namespace clatter {

TEST_CASE("Marked line: scripts follow their letter, and two beside each other share their place") {
  ImFontAtlas atlas;
  const Fonts fonts = add_fonts(atlas, 20.0f);
  const auto lines = marked_lines("aT_x^2b", fonts.title, fonts.text, 1000.0f);
  REQUIRE(lines.size() == 1);
  const auto& pieces = lines[0].pieces;
  REQUIRE(pieces.size() == 4);
  CHECK(pieces[0].letters == "aT");
  CHECK(pieces[0].font == fonts.title);
  CHECK(pieces[1].font == fonts.text);
  CHECK(pieces[1].place.x >= text_extent(fonts.title, "aT").x);
  CHECK(pieces[2].place.x == pieces[1].place.x);
  CHECK(pieces[3].place.x > pieces[2].place.x);
  // Baselines, downwards.
  const auto baseline = [](const MarkedLine::Piece& piece) {
    return piece.place.y + piece.font.ascent();
  };
  CHECK(baseline(pieces[1]) > baseline(pieces[0]) + 2.0f);
  CHECK(baseline(pieces[2]) < baseline(pieces[0]) - 5.0f);
  CHECK(std::abs(baseline(pieces[3]) - baseline(pieces[0])) <= 1.0f);
  // A script of the same kind follows the other.
  const auto twice = marked_lines("T_x_y", fonts.title, fonts.text, 1000.0f);
  CHECK(twice[0].pieces[2].place.x > twice[0].pieces[1].place.x);
}

TEST_CASE("Marked line: lines end at line breaks and between words") {
  ImFontAtlas atlas;
  const Fonts fonts = add_fonts(atlas, 20.0f);
  const auto lines_of = [&](const std::string& text, float wrap) {
    std::vector<std::string> texts;
    for (const MarkedLine& line : marked_lines(text, fonts.title, fonts.text, wrap)) {
      CHECK((line.width <= wrap || line.pieces.size() == 1));
      texts.emplace_back();
      for (const auto& piece : line.pieces) texts.back() += piece.letters + '|';
    }
    return texts;
  };
  using Texts = std::vector<std::string>;
  CHECK(lines_of("", 100.0f) == Texts{""});
  CHECK(lines_of("one two\n\nv_x end", 1000.0f) == Texts{"one|two|", "", "v|x|end|"});
  // The last word with its script is one pixel too long for the line.
  const float all = marked_lines("aaa bbb_{xx}", fonts.title, fonts.text, 1000.0f)[0].width;
  CHECK(lines_of("aaa bbb_{xx}", all) == Texts{"aaa|bbb|xx|"});
  CHECK(lines_of("aaa bbb_{xx} c", all - 1.0f) == Texts{"aaa|", "bbb|xx|c|"});
  CHECK(lines_of("aaaaaaaaaaaaaaaaaaaaa b", 60.0f) == Texts{"aaaaaaaaaaaaaaaaaaaaa|", "b|"});
}

}  // namespace clatter
