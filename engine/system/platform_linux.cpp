#include <fcntl.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "engine/system/allocation.h"
#include "engine/system/platform.h"

namespace clatter {

void prefer_huge_pages(void* memory, std::size_t bytes) {
  madvise(memory, bytes, MADV_HUGEPAGE);
}

double machine_memory() {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::min(machine, control_group_limits().memory);
}

// The set of processors must be as large as that of the kernel, which may have more than
// CPU_SETSIZE.
static int processors_of_affinity() {
  constexpr int kMost = 1 << 20;
  for (int size = CPU_SETSIZE; size <= kMost; size *= 2) {
    std::vector<cpu_set_t> set(static_cast<std::size_t>(size / CPU_SETSIZE));
    const std::size_t bytes = set.size() * sizeof(cpu_set_t);
    if (sched_getaffinity(0, bytes, set.data()) == 0) return CPU_COUNT_S(bytes, set.data());
  }
  return static_cast<int>(std::thread::hardware_concurrency());
}

int machine_processors() {
  const double quota = std::ceil(control_group_limits().processors);
  return static_cast<int>(std::clamp(quota, 1.0, std::max(1.0, 1.0 * processors_of_affinity())));
}

double heap_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

void return_unused_memory() {
  malloc_trim(0);
}

void restart_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

FileDescriptor nameless_file() {
  return FileDescriptor(memfd_create("clatter", MFD_CLOEXEC));
}

std::optional<Pipe> make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  return Pipe{FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

void end_with_parent() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

// /proc may be that of another namespace of processes, where this process has another number.
std::string name_while_open(const FileDescriptor& file, const std::string& path) {
  std::error_code error;
  const std::string number = std::filesystem::read_symlink("/proc/self", error).string();
  return error ? path : "/proc/" + number + "/fd/" + std::to_string(file.get());
}

std::string this_program(const std::string&) {
  return "/proc/self/exe";
}

}  // namespace clatter
