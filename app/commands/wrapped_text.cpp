#include "app/commands/wrapped_text.h"

#include <sstream>

namespace clatter {

std::string wrapped(const std::string& text, std::size_t width) {
  std::string lines;
  std::istringstream paragraphs(text);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    if (!lines.empty()) lines += '\n';
    // A line that begins with a space is an example.
    if (paragraph.starts_with(' ')) {
      lines += paragraph;
      continue;
    }
    std::istringstream words(paragraph);
    std::size_t column = 0;
    for (std::string word; words >> word; column += word.size()) {
      const bool breaks = column > 0 && column + 1 + word.size() > width;
      if (column > 0) lines += breaks ? '\n' : ' ';
      column = breaks ? 0 : column + (column > 0 ? 1 : 0);
      lines += word;
    }
  }
  return lines;
}

}  // namespace clatter
