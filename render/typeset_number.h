#pragma once

#include <cstdint>
#include <string>

namespace clatter {

/// A power of ten with its exponent in superscript digits: "10⁻⁵".
std::string power_text(int exponent);

/// A number in the notation of programs as in print: "2×10⁻⁵" for "2e-05". Other texts stay.
std::string typeset_number(const std::string& number);

/// A number with a thin space between groups of three digits: "1 234 567".
std::string grouped_digits(std::uint64_t number);

}  // namespace clatter
