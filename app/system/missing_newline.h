#pragma once

#include <filesystem>

namespace clatter {

/// Prints a note if a text file of particles ends without a newline. A file that was cut off may
/// end within a number, which then looks complete.
void note_missing_newline(const std::filesystem::path& file);

}  // namespace clatter
