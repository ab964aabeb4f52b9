#pragma once

#include <filesystem>
#include <string_view>

namespace clatter {

/// Whether a path is a device, a pipe, or an open file of ours such as /dev/stdout: written into,
/// never replaced.
bool is_special(const std::filesystem::path& path);

/// Writes a file that appears whole or not at all, even if the machine stops: it is written as
/// FILE.part beside its place, synced and renamed. The file that had the name before is renamed to
/// `previous` where that is given. A link is followed; a special file is written into. Throws
/// RunError, and then leaves no part.
void write_file(const std::filesystem::path& path, std::string_view bytes,
                const std::filesystem::path& previous = {});

/// Gives a file that another program has written its name, once the disk has it; throws RunError.
void rename_synced(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace clatter
