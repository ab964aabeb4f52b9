#include "app/system/process_usage.h"

#include <sys/resource.h>
#include <time.h>

namespace clatter {

// getrusage() divides the time between program and system by ticks. A run shorter than one tick can
// then have zero CPU time.
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace clatter
