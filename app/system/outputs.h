#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace clatter {

/// Writes to stdout at once. Throws RunError where that fails, say because it is closed.
void print(std::string_view text);

/// Throws UserError unless a file or folder of that name has a folder to be in; `flag` gave it.
void require_folder_of(const std::filesystem::path& path, const char* flag);

/// Throws what would keep write_file() from writing there, before a long run.
void require_writable_file(const std::filesystem::path& path, const char* flag);

/// Makes a folder where there is none; throws UserError where it has no folder to be in, and
/// RunError where files cannot be written into it. `flag` gave it.
void make_folder(const std::filesystem::path& folder, const char* flag);

/// A file or folder that a command writes, and the flag that gave it.
struct Output {
  const char* flag;
  std::filesystem::path path;  ///< empty: none
};

/// Throws UserError where two outputs have the same name, so that one would replace the other, or
/// an output has that of a file which the command reads. The files that are written on the way
/// count too: FILE.part and, of a checkpoint, FILE.previous.
void require_distinct(std::span<const Output> outputs,
                      std::span<const std::filesystem::path> inputs = {});

}  // namespace clatter
