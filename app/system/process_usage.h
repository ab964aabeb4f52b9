#pragma once

#include <cstdint>

namespace clatter {

/// CPU time of this process up to now, in seconds.
double cpu_seconds();

/// Largest resident size of this process, in bytes, since its start or restart_peak_memory().
std::uint64_t peak_memory_bytes();

}  // namespace clatter
