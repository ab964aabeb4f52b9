#pragma once

#include <filesystem>
#include <string_view>

namespace clatter {

/// Writes a whole file under a temporary name and renames it, so that the name never holds half of
/// it. Throws RunError where that fails.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Throws UserError unless a file of that name can be made: its folder exists and is one.
void require_folder_of(const std::filesystem::path& path, const char* flag);

}  // namespace clatter
