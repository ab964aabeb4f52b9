#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "engine/system/file_descriptor.h"

namespace clatter {

/// An open file that grows with a run. It is written in place: it has the complete records so far
/// during the run. Other processes cannot open it as a growing file.
class GrowingFile {
 public:
  /// Opens a file with the first `bytes` bytes of its content. Throws UserError if it has fewer,
  /// or if another process has opened it, and RunError if it cannot be written.
  GrowingFile(std::filesystem::path path, std::uint64_t bytes);

  /// Size of the complete records.
  std::uint64_t bytes() const { return bytes_; }
  /// Appends records. Throws RunError; the file then ends with the previous records.
  void append(std::string_view records);
  /// Writes bytes at a place in the file, counted from its begin. Throws RunError.
  void write(std::uint64_t place, std::string_view bytes);
  /// Waits until the records are on the disk. Throws RunError, also if the file has been removed.
  /// After a failure every later call throws, because the system reports a lost record once. Does
  /// nothing after close().
  void sync();
  /// Ends the file with the records on the disk. Throws RunError.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t bytes_;
  int lost_ = 0;  // error after which the content is unknown; 0: none
};

}  // namespace clatter
