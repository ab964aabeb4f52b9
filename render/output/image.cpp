#include "render/output/image.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

#include "engine/error.h"
#include "engine/system/write_file.h"

namespace {

// stb's own compressor is several times slower than libdeflate. The result is stb's to free().
unsigned char* compress_for_stb(unsigned char* data, int size, int* compressed_size, int) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(1), libdeflate_free_compressor);
  const size_t bound = libdeflate_zlib_compress_bound(compressor.get(), size);
  auto* compressed = static_cast<unsigned char*>(std::malloc(bound));
  *compressed_size =
      static_cast<int>(libdeflate_zlib_compress(compressor.get(), data, size, compressed, bound));
  return compressed;
}

}  // namespace

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBIW_ZLIB_COMPRESS compress_for_stb
#include <stb_image_write.h>

namespace clatter {

namespace {

// No filter: the pictures are flat areas, which compress best and fastest as they are. stb keeps
// the choice in a variable of its own, which is set here once, before any thread encodes.
[[maybe_unused]] const int kFilter = stbi_write_force_png_filter = 0;

// Signature (8 bytes) and IHDR (4 + 4 + 13 + 4): iTXt may follow, and must precede nothing else.
constexpr std::size_t kHeaderSize = 33;

void append_big_endian(std::vector<unsigned char>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back((value >> shift) & 0xff);
}

// PNG specification, 11.3.3.4: keyword, 0, compression flag and method, language, 0, keyword in
// that language, 0, text.
void append_text_chunk(std::vector<unsigned char>& bytes, const PngText& text) {
  std::string chunk = "iTXt" + text.keyword;
  chunk.append(5, '\0');
  chunk += text.text;
  append_big_endian(bytes, static_cast<std::uint32_t>(chunk.size() - 4));
  bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  append_big_endian(bytes, libdeflate_crc32(0, chunk.data(), chunk.size()));
}

}  // namespace

Image with_own_colours(Image image) {
  for (auto pixel = image.rgba.begin(); pixel != image.rgba.end(); pixel += 4) {
    const int alpha = pixel[3];
    for (int k = 0; alpha > 0 && k < 3; ++k) {
      pixel[k] = static_cast<unsigned char>(std::min(255, (255 * pixel[k] + alpha / 2) / alpha));
    }
  }
  return image;
}

std::vector<unsigned char> encode_png(const Image& image, std::span<const PngText> texts) {
  int size = 0;
  const std::unique_ptr<unsigned char, decltype(&std::free)> png(
      stbi_write_png_to_mem(image.rgba.data(), 4 * image.size.width, image.size.width,
                            image.size.height, 4, &size),
      std::free);
  if (!png) throw RunError("no memory for a PNG picture");

  std::vector<unsigned char> bytes(png.get(), png.get() + kHeaderSize);
  for (const PngText& text : texts) append_text_chunk(bytes, text);
  bytes.insert(bytes.end(), png.get() + kHeaderSize, png.get() + size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image,
               std::span<const PngText> texts) {
  const std::vector<unsigned char> bytes = encode_png(image, texts);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::optional<std::string> png_text(const std::filesystem::path& path, std::string_view keyword) {
  std::ifstream file(path, std::ios::binary);
  constexpr std::size_t kSignature = 8, kAround = 12;  // length, type and checksum of a chunk
  std::string bytes(kSignature, '\0');
  // Files without an end are no pictures.
  if (!file.read(bytes.data(), kSignature) || bytes != "\x89PNG\r\n\x1a\n") return std::nullopt;
  bytes.append(std::istreambuf_iterator<char>(file), {});
  const std::string wanted = "iTXt" + std::string(keyword) + std::string(5, '\0');
  for (std::size_t at = kSignature; at + kAround <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = 256 * length + static_cast<unsigned char>(bytes[at + i]);
    }
    const std::string_view chunk = std::string_view(bytes).substr(at + 4, length + 4);
    if (chunk.starts_with(wanted)) return std::string(chunk.substr(wanted.size()));
    at += length + kAround;
  }
  return std::nullopt;
}

}  // namespace clatter
