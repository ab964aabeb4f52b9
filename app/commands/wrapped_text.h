#pragma once

#include <cstddef>
#include <string>

namespace clatter {

/// Width of printed texts, in columns.
inline constexpr std::size_t kTextWidth = 96;

/// Breaks a text between words into lines of at most `width` columns. Keeps the line breaks of the
/// text.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace clatter
