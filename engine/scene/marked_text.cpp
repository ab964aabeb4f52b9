#include "engine/scene/marked_text.h"

#include <algorithm>

namespace clatter {

namespace {

constexpr std::string_view kEscaped = "_^{}\\";

// Removes the first letter of a text, encoded in UTF-8, and returns it. An escaped letter counts as
// one, without its backslash.
std::string take_letter(std::string_view& text) {
  if (text.size() > 1 && text[0] == '\\' && kEscaped.find(text[1]) != std::string_view::npos) {
    text.remove_prefix(1);
  }
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
  const auto end = std::find_if_not(text.begin() + 1, text.end(), continues);
  const std::string letter(text.begin(), end);
  text.remove_prefix(letter.size());
  return letter;
}

bool is_mark(char c) {
  return c == '_' || c == '^';
}

// Removes the letters after a mark and returns them. Sets `problem` if there are none, or too many.
std::string take_script(std::string_view& text, std::string& problem) {
  if (text.empty() || text[0] == ' ' || is_mark(text[0])) {
    problem = "a '_' or '^' has no letter after it";
    return "";
  }
  if (text[0] != '{') return take_letter(text);
  text.remove_prefix(1);
  std::string letters;
  while (!text.empty() && text[0] != '}') {
    if (is_mark(text[0])) problem = "a sub- or superscript contains another one";
    letters += take_letter(text);
  }
  if (text.empty()) {
    problem = "a '{' has no '}'";
  } else {
    text.remove_prefix(1);
  }
  return letters;
}

}  // namespace

MarkedText marked_text(std::string_view text) {
  MarkedText marked;
  while (!text.empty()) {
    if (is_mark(text[0])) {
      const auto script = text[0] == '_' ? TextRun::Below : TextRun::Above;
      text.remove_prefix(1);
      marked.runs.push_back({take_script(text, marked.problem), script});
      continue;
    }
    const std::string letter = take_letter(text);
    if (marked.runs.empty() || marked.runs.back().script != TextRun::Base) {
      marked.runs.push_back({"", TextRun::Base});
    }
    marked.runs.back().letters += letter;
  }
  return marked;
}

}  // namespace clatter
