#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// Letters of a text at one height.
struct TextRun {
  enum Script {
    Base,
    Below,  ///< subscript
    Above   ///< superscript
  };
  std::string letters;
  Script script = Base;

  bool operator==(const TextRun&) const = default;
};

/// A text with sub- and superscripts.
struct MarkedText {
  std::vector<TextRun> runs;
  std::string problem;  ///< what is wrong with the marks; empty: nothing
};

/// Reads the marks of a text. `_` lowers and `^` raises the next letter, or all letters between the
/// braces that follow: T_x, v^2, T_{refined}. A backslash before a mark, a brace or a backslash
/// stands for that letter.
MarkedText marked_text(std::string_view text);

}  // namespace clatter
