#pragma once

#include <cstdint>

namespace clatter {

/// CPU time of this process up to now, in seconds.
double cpu_seconds();

/// CPU time of this thread up to now, in seconds.
double thread_cpu_seconds();

/// CPU time of all child processes that have ended, in seconds.
double child_cpu_seconds();

/// Number of this process in the system. A forked process has another.
int process_number();

/// Largest resident size of this process, in bytes, since its start or restart_peak_memory().
std::uint64_t peak_memory_bytes();

}  // namespace clatter
