#pragma once

#include <string>
#include <string_view>

namespace clatter {

/// The text with its control characters as \u00XX. It then is one line, of full length also as a C
/// string.
std::string printable(std::string_view text);

}  // namespace clatter
