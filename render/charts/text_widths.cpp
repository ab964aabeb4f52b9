#include "render/charts/text_widths.h"

#include <array>

namespace clatter {

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
