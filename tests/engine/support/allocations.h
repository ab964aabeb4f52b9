#pragma once

#include <cstddef>

namespace clatter::testing {

/// Total number of bytes allocated up to now, including freed memory.
std::size_t allocated_bytes();

}  // namespace clatter::testing
