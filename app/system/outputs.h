#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace clatter {

/// Writes to stdout and flushes it. Throws RunError if this fails, for example on a closed stdout.
void print(std::string_view text);

/// Throws UserError if the parent folder of `path` does not exist. The error names `flag`.
void require_folder_of(const std::filesystem::path& path, const char* flag);

/// Throws the error that write_file() would throw for this path, so that it appears before a long
/// run. Throws UserError for a folder, and if the parent folder does not exist.
void require_writable_file(const std::filesystem::path& path, const char* flag);

/// Makes a folder unless it exists, and removes leftovers of killed runs from it. Throws UserError
/// if its parent folder does not exist, and RunError if the folder is not writable. The errors name
/// `flag`.
void make_folder(const std::filesystem::path& folder, const char* flag);

/// A file or folder that a command writes, with its flag.
struct Output {
  const char* flag;
  std::filesystem::path path;  ///< empty: none
};

/// Throws UserError if two outputs have the same path, or if an output is a file that the command
/// reads.
void require_distinct(std::span<const Output> outputs,
                      std::span<const std::filesystem::path> inputs = {});

}  // namespace clatter
