#include "engine/system/file_descriptor.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace clatter {

bool FileDescriptor::write_all(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool FileDescriptor::write_at(std::uint64_t place, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno != EINTR) return false;
    if (written <= 0) continue;
    bytes.remove_prefix(static_cast<std::size_t>(written));
    place += static_cast<std::uint64_t>(written);
  }
  return true;
}

std::size_t FileDescriptor::read_at(std::uint64_t place, std::span<char> bytes) const {
  const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

std::optional<std::uint64_t> FileDescriptor::size() const {
  struct stat status;
  if (fstat(descriptor_, &status) != 0) return std::nullopt;
  return static_cast<std::uint64_t>(status.st_size);
}

bool FileDescriptor::resize(std::uint64_t bytes) {
  return ftruncate(descriptor_, static_cast<off_t>(bytes)) == 0;
}

bool FileDescriptor::reserve(std::uint64_t bytes) {
  errno = posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  return errno == 0;
}

bool FileDescriptor::lock() {
  return flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

static bool set_lock(int descriptor, std::uint64_t place, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(place);
  lock.l_len = 1;
  return fcntl(descriptor, F_SETLK, &lock) == 0;
}

bool FileDescriptor::lock_byte(std::uint64_t place) {
  return set_lock(descriptor_, place, F_WRLCK);
}

bool FileDescriptor::unlock_byte(std::uint64_t place) {
  return set_lock(descriptor_, place, F_UNLCK);
}

bool FileDescriptor::sync() {
  return fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOSYS;
}

bool FileDescriptor::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  return descriptor < 0 || ::close(descriptor) == 0;
}

FileDescriptor open_for_writing(const std::filesystem::path& path, bool make) {
  return FileDescriptor(open(path.c_str(), O_WRONLY | O_CLOEXEC | (make ? O_CREAT : 0), 0666));
}

FileDescriptor open_for_update(const std::filesystem::path& path) {
  return FileDescriptor(open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
}

FileDescriptor open_folder(const std::filesystem::path& path) {
  return FileDescriptor(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

}  // namespace clatter
