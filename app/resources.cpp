#include "app/resources.h"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>

namespace clatter {

static rusage usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double cpu_seconds() {
  const timeval time = usage().ru_utime;
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::uint64_t peak_memory_bytes() {
  return static_cast<std::uint64_t>(usage().ru_maxrss) * 1024;
}

double heap_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

void restart_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace clatter
