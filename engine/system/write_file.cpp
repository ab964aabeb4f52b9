#include "engine/system/write_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "engine/error.h"
#include "engine/system/file_descriptor.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

[[noreturn]] void throw_unwritable(const std::filesystem::path& path, int error) {
  throw RunError("cannot write " + path.string() + ": " + std::strerror(error));
}

// Devices and pipes are written without sync, because they may not support it.
bool write_into(const std::filesystem::path& path, std::string_view bytes, bool sync) {
  FileDescriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  return file && file.write_all(std::as_bytes(std::span(bytes))) && (!sync || file.sync()) &&
         file.close();
}

bool sync_file(const std::filesystem::path& path) {
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file && file.sync();
}

// A folder may be writable but not readable. It then cannot be synced, and this counts as success.
bool sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  FileDescriptor file(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return file ? file.sync() : errno == EACCES;
}

bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0;
}

// The descriptor behind a name such as /dev/stdout or /dev/fd/3. It may be a regular file; writing
// then continues at its current position.
std::optional<int> own_descriptor(std::filesystem::path path) {
  std::error_code error;
  const std::filesystem::path open_files = std::filesystem::canonical("/proc/self/fd", error);
  constexpr int kMostLinks = 40;
  for (int links = 0; !error && links < kMostLinks; ++links) {
    if (std::filesystem::canonical(path.parent_path(), error) == open_files) {
      return whole_number<int>(path.filename().string());
    }
    if (error || !std::filesystem::is_symlink(path, error)) break;
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  }
  return std::nullopt;
}

// The target of a link, so that the link itself is not replaced.
std::filesystem::path place_of(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path place = std::filesystem::canonical(path, error);
  return error ? path : place;
}

}  // namespace

bool is_special(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_other(path, ignored) || own_descriptor(path);
}

void write_file(const std::filesystem::path& path, std::string_view bytes,
                const std::filesystem::path& previous) {
  if (const std::optional<int> own = own_descriptor(path)) {
    FileDescriptor file(dup(*own));
    if (!file || !file.write_all(std::as_bytes(std::span(bytes)))) throw_unwritable(path, errno);
    return;
  }
  if (is_special(path)) {
    if (!write_into(path, bytes, false)) throw_unwritable(path, errno);
    return;
  }
  const std::filesystem::path place = place_of(path);
  const std::filesystem::path part = place.string() + ".part";
  std::error_code ignored;
  const bool keep = !previous.empty() && std::filesystem::exists(place, ignored);
  const bool written = write_into(part, bytes, true);
  if (written && (!keep || rename_file(place, previous)) && rename_file(part, place) &&
      sync_folder_of(place)) {
    return;
  }
  const int error = errno;
  std::remove(part.c_str());
  throw_unwritable(written ? path : part, error);
}

void rename_synced(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (!sync_file(from) || !rename_file(from, to) || !sync_folder_of(to)) {
    throw_unwritable(to, errno);
  }
}

}  // namespace clatter
