#pragma once

#include <filesystem>
#include <string_view>

namespace clatter {

/// Writes a file and waits until it is on the disk; throws RunError and leaves none where that
/// fails.
void write_synced(const std::filesystem::path& file, std::string_view bytes);

/// Renames a file within its folder and waits until the disk knows; throws RunError.
void rename_synced(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace clatter
