#pragma once

#include <cstdint>

namespace clatter {

/// User CPU time of this process so far, seconds.
double cpu_seconds();

/// Largest resident size of this process so far, bytes.
std::uint64_t peak_memory_bytes();

}  // namespace clatter
