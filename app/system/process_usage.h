#pragma once

#include <cstdint>

namespace clatter {

/// CPU time of this process so far, seconds.
double cpu_seconds();

/// Largest resident size of this process so far, or since restart_peak_memory(), bytes.
std::uint64_t peak_memory_bytes();

/// What is allocated at present, bytes.
double heap_bytes();

/// Takes the resident size of now as the largest so far, where the system can (Linux).
void restart_peak_memory();

}  // namespace clatter
