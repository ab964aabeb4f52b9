#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <thread>

#include "engine/system/platform.h"

namespace clatter {

void prefer_huge_pages(void*, std::size_t) {}

double machine_memory() {
  return std::numeric_limits<double>::infinity();
}

int machine_processors() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

double heap_bytes() {
  return 0.0;
}

void return_unused_memory() {}

void restart_peak_memory() {}

static bool close_in_children(const FileDescriptor& file) {
  return fcntl(file.get(), F_SETFD, FD_CLOEXEC) == 0;
}

FileDescriptor nameless_file() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "clatter-XXXXXX").string();
  if (error) name = "/tmp/clatter-XXXXXX";
  FileDescriptor file(mkstemp(name.data()));
  if (file) unlink(name.c_str());
  return file && close_in_children(file) ? std::move(file) : FileDescriptor();
}

std::optional<Pipe> make_pipe() {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  Pipe pipe{FileDescriptor(ends[0]), FileDescriptor(ends[1])};
  if (!close_in_children(pipe.output) || !close_in_children(pipe.input)) return std::nullopt;
  return pipe;
}

void end_with_parent() {}

std::string name_while_open(const FileDescriptor&, const std::string& path) {
  return path;
}

std::string this_program(const std::string& name) {
  return name;
}

}  // namespace clatter
