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

/// Converts colours premultiplied by alpha to the unmultiplied colours of PNG files.
Image with_own_colours(Image image);

/// A text in a PNG file, stored as an iTXt chunk.
struct PngText {
  std::string keyword;  ///< 1..79 Latin-1 characters, e.g. "Title"
  std::string text;     ///< UTF-8
};

/// The bytes of a PNG file. Throws RunError if there is not enough memory.
std::vector<unsigned char> encode_png(const Image& image, std::span<const PngText> texts = {});

/// True if the path is a regular file with the signature of a PNG file.
bool is_png(const std::filesystem::path& path);

/// True if the path is a PNG file from its signature to its end, and each chunk has its CRC-32. The
/// pixels are not decoded.
bool is_whole_png(const std::filesystem::path& path);

/// The text of a keyword before the pixels of a PNG file; absent: no such text, or no PNG file.
/// Throws UserError if the texts are damaged.
std::optional<std::string> png_text(const std::filesystem::path& path, std::string_view keyword);

/// Writes a PNG file, completely or not at all. Throws RunError if that fails.
void write_png(const std::filesystem::path& path, const Image& image,
               std::span<const PngText> texts = {});

/// Structural similarity index of two pictures of equal size (Wang, Bovik, Sheikh & Simoncelli
/// 2004); 1: equal. It is the mean over the luma of squares of 8 x 8 pixels, 4 pixels apart.
double structural_similarity(const Image& a, const Image& b);

/// A picture resampled to another size with bilinear interpolation.
Image resized(const Image& image, Size size);

}  // namespace clatter
