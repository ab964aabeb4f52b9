#include "render/layers/text_widths.h"

#include <array>
#include <sstream>

#include "render/layers/fonts.h"

namespace clatter {

static constexpr double kMeasured = 32.0;  // size, pixels per em

TextWidths::TextWidths(const std::string& letters) {
  add_letters(atlas_, letters, std::array{kMeasured});
}

double TextWidths::operator()(const std::string& text, double size) const {
  return text_extent(*atlas_.Fonts[0], text).x * size / kMeasured;
}

std::vector<std::string> TextWidths::lines(const std::string& text, double size,
                                           double width) const {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + ' ' + word;
    if (!lines.empty() && (*this)(longer, size) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace clatter
