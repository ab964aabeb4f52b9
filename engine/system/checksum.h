#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace clatter {

/// CRC-32 of bytes, as in PNG files.
std::uint32_t checksum(std::string_view bytes);

/// CRC-32 of bytes after others with the CRC-32 `before`.
std::uint32_t continued_checksum(std::uint32_t before, std::string_view bytes);

/// CRC-32 of a file's content; absent if it cannot be read.
std::optional<std::uint32_t> checksum_of_file(const std::filesystem::path& file);

}  // namespace clatter
