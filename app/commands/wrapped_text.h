#pragma once

#include <cstddef>
#include <string>

namespace clatter {

/// Columns of the texts that the program prints for people.
inline constexpr std::size_t kTextWidth = 96;

/// Breaks a text between words into lines of at most `width` columns. New lines in the text stay.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace clatter
