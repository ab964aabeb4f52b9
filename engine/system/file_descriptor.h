#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace clatter {

/// Owns an open file or folder.
class FileDescriptor {
 public:
  /// Owns a descriptor of the system; negative: none.
  explicit FileDescriptor(int descriptor = -1) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileDescriptor() { close(); }

  explicit operator bool() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

  /// Writes all bytes; false with errno on failure.
  bool write_all(std::span<const std::byte> bytes);
  /// Writes all bytes at a place, counted from the start of the file; false with errno on failure.
  bool write_at(std::uint64_t place, std::string_view bytes);
  /// Reads bytes from a place on. Returns their number, 0 at the end of the file and on failure.
  std::size_t read_at(std::uint64_t place, std::span<char> bytes) const;
  /// Size of the file in bytes; absent with errno on failure.
  std::optional<std::uint64_t> size() const;
  /// Cuts or extends the file to a number of bytes; false with errno on failure.
  bool resize(std::uint64_t bytes);
  /// Reserves room on the disk for the first bytes of the file; false with errno on failure.
  bool reserve(std::uint64_t bytes);
  /// Locks the file or folder until it is closed. False if another program has the lock. A file
  /// system without locks counts as success.
  bool lock();
  /// Locks one byte of the file for this process, also across the machines of a cluster. False with
  /// errno on failure: EACCES or EAGAIN if another process has the lock.
  bool lock_byte(std::uint64_t place);
  /// Ends the lock of one byte; false with errno on failure.
  bool unlock_byte(std::uint64_t place);

  /// Waits until the file or folder is on the disk; false with errno on failure. A file system
  /// without sync counts as success.
  bool sync();

  /// Closes it; false with errno if the system reports a late write error.
  bool close();

 private:
  int descriptor_;
};

// Child processes do not get the descriptors that these functions open.

/// Opens a file for writing, and makes it if it is missing and `make` is set. None with errno on
/// failure.
FileDescriptor open_for_writing(const std::filesystem::path& path, bool make = true);
/// Opens a file for reading and writing, and makes it if it is missing. None with errno on failure,
/// and for a link.
FileDescriptor open_for_update(const std::filesystem::path& path);
/// Opens a folder. None with errno on failure.
FileDescriptor open_folder(const std::filesystem::path& path);

}  // namespace clatter
