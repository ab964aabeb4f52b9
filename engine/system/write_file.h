#pragma once

#include <filesystem>
#include <string_view>

#include "engine/system/file_descriptor.h"

// Files appear whole or not at all, even if the machine stops (engine/system/write_file.h). They
// are written in the same folder under another name, synced and renamed. A lock shows that the
// hidden file is in use, so that a later run can remove those of killed runs (remove_leftovers).
// Devices and pipes are written into. Exception: trajectories and event logs are written in place,
// so that they can be read during the run. They are synced before each checkpoint and at the end. A
// resumed run cuts the records after its checkpoint.

namespace clatter {

/// Whether a path is a device, a pipe, or an open file of this process such as /dev/stdout. These
/// are written into and never replaced.
bool is_special(const std::filesystem::path& path);

/// The path behind a chain of links. A link stays where a chain has no end.
std::filesystem::path target_of(std::filesystem::path path);

/// Whether this process may make files in a folder; false with errno.
bool may_write_in(const std::filesystem::path& folder);

/// True if `path` still names the open file or folder.
bool is_at(const FileDescriptor& file, const std::filesystem::path& path);

/// A file that did not exist before.
struct NewFile {
  std::filesystem::path path;
  FileDescriptor file;  ///< open for writing
};

/// Creates the empty hidden file .FILE.clatter-NUMBER in the folder of `target`, and locks it by
/// flock(). No other file has this name. Without a file, `errno` has the reason. The lock shows
/// other runs that the file is in use. Who writes it through another descriptor, and locks that
/// one, closes this one before.
NewFile new_file_beside(const std::filesystem::path& target);

/// Removes the hidden files of new_file_beside() that killed runs have left in a folder: those
/// without a lock. A file system without locks keeps them.
void remove_leftovers(const std::filesystem::path& folder);

/// Throws the error that write_file() would throw for this path, except for a full disk. Creates
/// and removes a temporary file. Removes leftovers from the folder.
void require_writable(const std::filesystem::path& path);

/// Writes a file atomically, even if the machine stops: writes a hidden file in the same folder,
/// syncs it and renames it. An existing file is renamed to `previous`, if given. Links
/// are followed; a special file is written into. Throws RunError, also if the file is
/// write-protected, and then removes the temporary file.
void write_file(const std::filesystem::path& path, std::string_view bytes,
                const std::filesystem::path& previous = {});

/// Syncs a file that another program has written, then renames it. Throws RunError.
void rename_synced(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace clatter
