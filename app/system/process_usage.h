#pragma once

#include <cstdint>

namespace clatter {

/// CPU time of this process so far, seconds.
double cpu_seconds();

/// Largest resident size of this process so far, or since restart_peak_memory(), bytes.
std::uint64_t peak_memory_bytes();

}  // namespace clatter
