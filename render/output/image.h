#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/camera.h"

namespace clatter {

/// A picture in memory.
struct Image {
  Size size;
  std::vector<unsigned char> rgba;  ///< [height][width][4], top row first
};

/// A picture whose colours are times their opacity, with colours as PNG files have them: not.
Image with_own_colours(Image image);

/// A note inside a PNG file, as an iTXt chunk.
struct PngText {
  std::string keyword;  ///< 1..79 Latin-1 characters, e.g. "Title"
  std::string text;     ///< UTF-8
};

/// The bytes of a PNG file.
std::vector<unsigned char> encode_png(const Image& image, std::span<const PngText> texts = {});

/// Whether a path is a regular file that begins as PNG pictures do.
bool is_png(const std::filesystem::path& path);

/// The text that a PNG file carries under a keyword before its pixels; absent: none, or no PNG
/// file. Throws UserError where the file is damaged up to there.
std::optional<std::string> png_text(const std::filesystem::path& path, std::string_view keyword);

/// Writes a PNG file, whole or not at all; throws RunError.
void write_png(const std::filesystem::path& path, const Image& image,
               std::span<const PngText> texts = {});

}  // namespace clatter
