#pragma once

#include <string>
#include <vector>

#include "render/typography/fonts.h"

namespace clatter {

/// Measures texts of any size. All sizes of the typeface have the same proportions.
class TextWidths {
 public:
  /// Measures texts with these letters.
  explicit TextWidths(const std::string& letters);
  TextWidths(const TextWidths&) = delete;
  TextWidths& operator=(const TextWidths&) = delete;

  /// The width of a text of one line. `size` is in pixels per em.
  double operator()(const std::string& text, double size) const;

  /// The lines of a text broken at a width, in pixels. A longer word has a line of its own.
  std::vector<std::string> lines(const std::string& text, double size, double width) const;

 private:
  ImFontAtlas atlas_;
  Font font_;
};

}  // namespace clatter
