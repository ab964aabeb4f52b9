#pragma once

#include <cstddef>
#include <string>

namespace clatter {

/// All bytes of a file that the user named. Throws UserError if it cannot be read or has more than
/// `largest` bytes. `wanted` is the advice of the latter error.
std::string read_file(const std::string& path, std::size_t largest, const std::string& wanted);

}  // namespace clatter
