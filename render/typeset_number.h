#pragma once

#include <string>

namespace clatter {

/// A power of ten with its exponent in superscript digits: "10⁻⁵".
std::string power_text(int exponent);

/// A number in the notation of programs as in print: "2×10⁻⁵" for "2e-05". Other texts stay.
std::string typeset_number(const std::string& number);

}  // namespace clatter
