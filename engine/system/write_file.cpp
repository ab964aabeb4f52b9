#include "engine/system/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "engine/error.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

[[noreturn]] void throw_unwritable(const std::filesystem::path& path, int error) {
  throw RunError("cannot write " + path.string() + ": " + std::strerror(error));
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// Devices and pipes are written without sync, because they may not support it.
bool write_into(const std::filesystem::path& path, std::string_view bytes) {
  FileDescriptor file = open_for_writing(path, false);
  return file && file.write_all(bytes_of(bytes)) && file.close();
}

bool sync_file(const std::filesystem::path& path) {
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file && file.sync();
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

// A folder may be writable but not readable. It then cannot be synced, and this counts as success.
bool sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = folder_of(path);
  FileDescriptor file = open_folder(folder);
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
    path = std::filesystem::absolute(path, error);
    if (std::filesystem::canonical(path.parent_path(), error) == open_files) {
      return whole_number<int>(path.filename().string());
    }
    if (error || !std::filesystem::is_symlink(path, error)) break;
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  }
  return std::nullopt;
}

void require_replaceable(const std::filesystem::path& path, const std::filesystem::path& target) {
  using std::filesystem::perms;
  constexpr perms kWritable = perms::owner_write | perms::group_write | perms::others_write;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(target, error);
  if (error == std::errc::filename_too_long) throw_unwritable(path, ENAMETOOLONG);
  if (is_symlink(status)) throw_unwritable(path, ELOOP);
  if (is_directory(status)) throw_unwritable(path, EISDIR);
  if (is_regular_file(status) && (status.permissions() & kWritable) == perms::none) {
    throw RunError("cannot write " + path.string() +
                   ": it is write-protected; make it writable, or give another name");
  }
}

constexpr std::string_view kHidden = ".clatter-";  // before the number of a hidden file

// Whether a name is that of a hidden file, or of the file that collects its records.
bool is_hidden(std::string_view name) {
  const std::size_t mark = name.rfind(kHidden);
  if (!name.starts_with('.') || mark == 0 || mark == name.npos) return false;
  const std::string_view number = name.substr(mark + kHidden.size());
  const std::size_t end = std::min(number.find_first_not_of("0123456789-"), number.size());
  return end > 0 && (end == number.size() || number.substr(end) == ".records");
}

// True if the file system has locks and no other process has one on this file.
bool has_lock(const FileDescriptor& file) {
  return flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

}  // namespace

bool may_write_in(const std::filesystem::path& folder) {
  return access(folder.c_str(), W_OK) == 0;
}

bool is_at(const FileDescriptor& file, const std::filesystem::path& path) {
  struct stat opened, named;
  return fstat(file.get(), &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void remove_leftovers(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path& path = entry.path();
    if (!is_hidden(path.filename().native()) || !entry.is_regular_file(ignored)) continue;
    const FileDescriptor file(open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
    if (file && has_lock(file) && is_at(file, path)) unlink(path.c_str());
  }
}

NewFile new_file_beside(const std::filesystem::path& target) {
  constexpr int kMostBytes = 200;  // of the name: a longer one may leave no room for the rest
  for (int number = 0;; ++number) {
    const std::filesystem::path path =
        target.parent_path() / fmt::format(".{:.{}}{}{}-{}", target.filename().string(), kMostBytes,
                                           kHidden, getpid(), number);
    FileDescriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file && errno == EEXIST) continue;
    // Another run may have taken the file for a leftover before it was locked.
    const bool lost = file && !file.lock();
    if (!file || (!lost && is_at(file, path))) return {path, std::move(file)};
  }
}

bool is_special(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_other(path, ignored) || own_descriptor(path);
}

std::filesystem::path target_of(std::filesystem::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int links = 0; links < kMostLinks && std::filesystem::is_symlink(path, error); ++links) {
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  }
  return path;
}

void require_writable(const std::filesystem::path& path) {
  if (is_special(path)) {
    if (access(path.c_str(), W_OK) != 0) throw_unwritable(path, errno);
    return;
  }
  const std::filesystem::path target = target_of(path);
  require_replaceable(path, target);
  remove_leftovers(folder_of(target));
  const NewFile part = new_file_beside(target);
  if (!part.file) throw_unwritable(path, errno);
  std::remove(part.path.c_str());
}

void write_file(const std::filesystem::path& path, std::string_view bytes,
                const std::filesystem::path& previous) {
  if (const std::optional<int> own = own_descriptor(path)) {
    FileDescriptor file(dup(*own));
    if (!file || !file.write_all(bytes_of(bytes))) throw_unwritable(path, errno);
    return;
  }
  if (is_special(path)) {
    if (!write_into(path, bytes)) throw_unwritable(path, errno);
    return;
  }
  const std::filesystem::path target = target_of(path);
  require_replaceable(path, target);
  NewFile part = new_file_beside(target);
  if (!part.file) throw_unwritable(path, errno);
  const FileDescriptor locked(dup(part.file.get()));  // until the file has its name
  const bool written =
      part.file.write_all(bytes_of(bytes)) && part.file.sync() && part.file.close();
  // Another run may have moved the previous file.
  if (written && (previous.empty() || rename_file(target, previous) || errno == ENOENT) &&
      rename_file(part.path, target) && sync_folder_of(target)) {
    return;
  }
  const int error = errno;
  std::remove(part.path.c_str());
  throw_unwritable(path, error);
}

void rename_synced(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (!sync_file(from) || !rename_file(from, to) || !sync_folder_of(to)) {
    throw_unwritable(to, errno);
  }
}

}  // namespace clatter
