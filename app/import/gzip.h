#pragma once

#include <filesystem>
#include <string>

namespace clatter {

/// Whether a file begins with the magic of gzip (RFC 1952).
bool is_gzip(const std::filesystem::path& path);

/// The content of a file that gzip has compressed, in one part or in several. Throws UserError if
/// it is damaged, or has more than 4 GB.
std::string gunzipped(const std::filesystem::path& path);

}  // namespace clatter
