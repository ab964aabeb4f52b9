#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "engine/system/platform.h"

namespace clatter {

void prefer_huge_pages(void* memory, std::size_t bytes) {
  madvise(memory, bytes, MADV_HUGEPAGE);
}

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
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

std::string name_while_open(const FileDescriptor& file, const std::string&) {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file.get());
}

std::string this_program(const std::string&) {
  return "/proc/self/exe";
}

}  // namespace clatter
