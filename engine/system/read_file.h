#pragma once

#include <cstddef>
#include <string>

namespace clatter {

/// All bytes of a file that a person named. Throws UserError where it cannot be read or has more
/// than `largest` bytes, and then says that it should be `wanted`.
std::string read_file(const std::string& path, std::size_t largest, const std::string& wanted);

}  // namespace clatter
