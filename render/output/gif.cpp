#include "render/output/gif.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "engine/system/read_file.h"

namespace clatter {

namespace {

// Places in the blocks (GIF89a specification, sections 18 to 26).
constexpr std::size_t kScreen = 13, kScreenFlags = 10;  // signature and logical screen
constexpr std::size_t kImage = 11, kImageFlags = 9;     // descriptor and code size
constexpr std::size_t kControl = 8, kDelay = 4;         // graphic control extension
constexpr unsigned kHasPalette = 0x80, kPaletteSize = 0x07;
constexpr std::string_view kSignature = "GIF89a", kTrailer = ";";
constexpr std::string_view kForEver("!\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 19);

struct GifPicture {
  std::string_view control;  // its graphic control extension; empty: none
  std::string_view image;    // descriptor, palette and data
};

struct Gif {
  std::string_view screen;   // empty: no GIF
  std::string_view palette;  // of pictures without an own one
  std::vector<GifPicture> pictures;
  bool whole = false;  // whether the last block is the trailer
};

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

std::size_t palette_bytes(unsigned flags) {
  return flags & kHasPalette ? 3u << ((flags & kPaletteSize) + 1) : 0;
}

// Number of bytes of the block at the begin of `bytes`, with its data; 0: no whole block.
std::size_t block_size(std::string_view bytes) {
  std::size_t at = 2;
  if (bytes.starts_with(',')) {
    if (bytes.size() < kImage) return 0;
    at = kImage + palette_bytes(byte_at(bytes, kImageFlags));
  } else if (!bytes.starts_with('!')) {
    return 0;
  }
  while (at < bytes.size() && bytes[at] != '\0') at += 1 + byte_at(bytes, at);
  return at < bytes.size() ? at + 1 : 0;
}

Gif read_gif(std::string_view bytes) {
  Gif gif;
  if (!bytes.starts_with(kSignature) || bytes.size() < kScreen) return gif;
  const std::size_t palette = palette_bytes(byte_at(bytes, kScreenFlags));
  if (bytes.size() < kScreen + palette) return gif;
  gif.screen = bytes.substr(0, kScreen);
  gif.palette = bytes.substr(kScreen, palette);
  bytes.remove_prefix(kScreen + palette);
  std::string_view control;
  while (const std::size_t size = block_size(bytes)) {
    const std::string_view block = bytes.substr(0, size);
    bytes.remove_prefix(size);
    if (block.starts_with(',')) {
      gif.pictures.push_back({control, block});
      control = {};
    } else if (block.starts_with("!\xf9") && size == kControl) {
      control = block;
    }
  }
  gif.whole = bytes == kTrailer;
  return gif;
}

std::string bytes_of_file(const std::filesystem::path& path) {
  try {
    return read_file(path.string(), std::numeric_limits<std::size_t>::max() / 2, "");
  } catch (const UserError& error) {
    throw RunError(error.what());
  }
}

// Delay of a picture in hundredths of a second.
int delay_of(long number, double fps) {
  const auto end_of = [fps](long pictures) {
    return std::lround(100.0 * static_cast<double>(pictures) / fps);
  };
  return static_cast<int>(end_of(number + 1) - end_of(number));
}

// A picture that does not need the palette of its own GIF.
std::string standalone(const GifPicture& picture, const Gif& gif, int delay) {
  std::string bytes(picture.control);
  if (bytes.empty()) bytes = std::string("!\xf9\x04\0\0\0\0\0", kControl);
  bytes[kDelay] = static_cast<char>(delay & 0xff);
  bytes[kDelay + 1] = static_cast<char>(delay >> 8);
  const unsigned flags = byte_at(picture.image, kImageFlags);
  if (flags & kHasPalette || gif.palette.empty()) return bytes.append(picture.image);
  const unsigned size = byte_at(gif.screen, kScreenFlags) & kPaletteSize;
  bytes += picture.image.substr(0, kImageFlags);
  bytes += static_cast<char>((flags & ~kPaletteSize) | kHasPalette | size);
  return bytes.append(gif.palette).append(picture.image.substr(kImageFlags + 1));
}

// The screen of a GIF without a palette.
std::string bare_screen(const Gif& gif) {
  std::string bytes(gif.screen);
  bytes[kScreenFlags] =
      static_cast<char>(byte_at(gif.screen, kScreenFlags) & ~(kHasPalette | kPaletteSize));
  return bytes;
}

}  // namespace

std::optional<long> pictures_in_gif(const std::filesystem::path& film) {
  std::string start(kSignature.size(), '\0');
  std::ifstream(film, std::ios::binary).read(start.data(), static_cast<long>(start.size()));
  if (start != kSignature) return std::nullopt;
  const std::string bytes = bytes_of_file(film);
  return static_cast<long>(read_gif(bytes).pictures.size());
}

void join_gifs(const std::vector<FilmPart>& parts, double fps, FileDescriptor& joined) {
  const auto write = [&joined](std::string_view bytes) {
    if (!joined.write_all(std::as_bytes(std::span(bytes)))) throw RunError(std::strerror(errno));
  };
  long number = 0;
  for (const FilmPart& part : parts) {
    const std::string bytes = bytes_of_file(part.path);
    const Gif gif = read_gif(bytes);
    const auto found = static_cast<long>(gif.pictures.size());
    if (found != part.count || !gif.whole) {
      throw RunError(fmt::format("{} has {} of {} pictures; is the disk full?", part.path.string(),
                                 found, part.count));
    }
    if (number == 0) write(bare_screen(gif) + std::string(kForEver));
    for (const GifPicture& picture : gif.pictures) {
      write(standalone(picture, gif, delay_of(number, fps)));
      ++number;
    }
  }
  write(kTrailer);
}

}  // namespace clatter
