#pragma once

#include <cstddef>

namespace clatter::testing {

/// Total number of bytes allocated up to now, including freed memory.
std::size_t allocated_bytes();

/// Number of bytes in use now.
std::size_t bytes_in_use();
/// The largest number of bytes in use since the start or restart_most_bytes_in_use().
std::size_t most_bytes_in_use();
void restart_most_bytes_in_use();

}  // namespace clatter::testing
