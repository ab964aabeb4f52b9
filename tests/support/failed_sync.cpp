// A library to preload. The first fsync() of a CSV file fails, as after a write error of the disk.

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace {

std::string path_of(int descriptor) {
  std::string path(4096, '\0');
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = readlink(link.c_str(), path.data(), path.size());
  path.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return path;
}

bool failed = false;

}  // namespace

extern "C" int fsync(int descriptor) {
  if (!failed && path_of(descriptor).ends_with(".csv")) {
    failed = true;
    errno = EIO;
    return -1;
  }
  static const auto found = reinterpret_cast<int (*)(int)>(dlsym(RTLD_NEXT, "fsync"));
  return found(descriptor);
}
