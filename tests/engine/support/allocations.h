#pragma once

#include <cstddef>

namespace clatter::testing {

/// Bytes that the program has asked for so far, given back or not.
std::size_t allocated_bytes();

}  // namespace clatter::testing
