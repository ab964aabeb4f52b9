#include <spawn.h>

#include <cerrno>

#include "engine/system/platform.h"

// A page has no processes. The C library of emscripten declares this function without a definition.
extern "C" int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*,
                            const posix_spawnattr_t*, char* const*, char* const*) {
  return ENOSYS;
}

namespace clatter {

void prefer_huge_pages(void*, std::size_t) {}

// WebAssembly addresses 4 GB. Browsers may give less, and a page of a phone much less.
double machine_memory() {
  return 1e9;
}

int machine_processors() {
  return 1;
}

double heap_bytes() {
  return 0.0;
}

void return_unused_memory() {}

void restart_peak_memory() {}

FileDescriptor nameless_file() {
  errno = ENOSYS;
  return FileDescriptor();
}

std::optional<Pipe> make_pipe() {
  errno = ENOSYS;
  return std::nullopt;
}

void end_with_parent() {}

std::string name_while_open(const FileDescriptor&, const std::string& path) {
  return path;
}

std::string this_program(const std::string& name) {
  return name;
}

}  // namespace clatter
