#include "render/output/image.h"

#include <libdeflate.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include "engine/error.h"
#include "engine/system/read_file.h"
#include "engine/system/write_file.h"

namespace {

// libdeflate is several times faster than the compressor of stb. stb calls free() on the result.
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

#include <cmath>

namespace clatter {

namespace {

// No filter: pictures of flat areas compress best and fastest without one. The global variable of
// stb is set once, before any thread encodes.
[[maybe_unused]] const int kFilter = stbi_write_force_png_filter = 0;

// Signature (8 bytes) and IHDR (4 + 4 + 13 + 4). iTXt chunks may follow directly.
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

static std::uint32_t big_endian_at(const unsigned char* bytes) {
  std::uint32_t number = 0;
  for (int k = 0; k < 4; ++k) number = number << 8 | bytes[k];
  return number;
}

// The texts of a picture before its pixels. Throws UserError if they are damaged.
static std::vector<PngText> texts_of(std::FILE* file, const std::filesystem::path& path) {
  constexpr std::size_t kLargest = 16'000'000;  // limit for a chunk and for all chunks, bytes
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(0), spng_ctx_free);
  spng_set_crc_action(png.get(), SPNG_CRC_ERROR, SPNG_CRC_ERROR);
  spng_set_chunk_limits(png.get(), kLargest, kLargest);
  spng_set_png_file(png.get(), file);
  std::uint32_t count = 0;
  int error = spng_get_text(png.get(), nullptr, &count);
  if (error == SPNG_ECHUNKAVAIL) return {};
  std::vector<spng_text> found(count);
  if (error == 0) error = spng_get_text(png.get(), found.data(), &count);
  if (error != 0) {
    throw UserError({path.string()}, std::string("the picture is damaged: ") + spng_strerror(error),
                    "copy the original again");
  }
  std::vector<PngText> texts;
  for (const spng_text& text : found) texts.push_back({text.keyword, {text.text, text.length}});
  return texts;
}

// Regular files only: reading the signature from a pipe would consume it.
bool is_png(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<char, kSignature.size()> start{};
  file.read(start.data(), start.size());
  return file && std::string_view(start.data(), start.size()) == kSignature;
}

// PNG specification, 5.3: a chunk has its length, its type, its data and the CRC of type and data.
bool is_whole_png(const std::filesystem::path& path) {
  constexpr std::size_t kSignature = 8, kAround = 12;  // bytes, kAround: beside the data of a chunk
  if (!is_png(path)) return false;
  std::ifstream file(path, std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t at = kSignature; at + kAround <= bytes.size();) {
    const std::size_t length = big_endian_at(&bytes[at]);
    if (length > bytes.size() - at - kAround) return false;
    const unsigned char* type = &bytes[at + 4];
    if (libdeflate_crc32(0, type, 4 + length) != big_endian_at(type + 4 + length)) return false;
    at += kAround + length;
    if (std::string_view(reinterpret_cast<const char*>(type), 4) == "IEND") {
      return at == bytes.size();
    }
  }
  return false;
}

std::optional<std::string> png_text(const std::filesystem::path& path, std::string_view keyword) {
  if (!is_png(path)) return std::nullopt;
  const CStream file(std::fopen(path.c_str(), "rb"));
  if (!file) return std::nullopt;
  for (PngText& text : texts_of(file.get(), path)) {
    if (text.keyword == keyword) return std::move(text.text);
  }
  return std::nullopt;
}

static double luma(const Image& image, int x, int y) {
  const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) +
                       static_cast<std::size_t>(x));
  return 0.299 * image.rgba[at] + 0.587 * image.rgba[at + 1] + 0.114 * image.rgba[at + 2];
}

double structural_similarity(const Image& a, const Image& b) {
  constexpr int kSquare = 8, kStride = 4;
  constexpr double kMean = 0.01 * 255.0 * 0.01 * 255.0, kVariance = 0.03 * 255.0 * 0.03 * 255.0;
  constexpr double kPixels = kSquare * kSquare;
  double sum = 0.0;
  int squares = 0;
  for (int top = 0; top + kSquare <= a.size.height; top += kStride) {
    for (int left = 0; left + kSquare <= a.size.width; left += kStride) {
      double sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
      for (int k = 0; k < kSquare * kSquare; ++k) {
        const int x = left + k % kSquare, y = top + k / kSquare;
        const double of_a = luma(a, x, y), of_b = luma(b, x, y);
        sum_a += of_a;
        sum_b += of_b;
        aa += of_a * of_a;
        bb += of_b * of_b;
        ab += of_a * of_b;
      }
      const double mean_a = sum_a / kPixels, mean_b = sum_b / kPixels;
      const double means = mean_a * mean_a + mean_b * mean_b, product = mean_a * mean_b;
      sum += (2.0 * product + kMean) * (2.0 * (ab / kPixels - product) + kVariance) /
             ((means + kMean) * ((aa + bb) / kPixels - means + kVariance));
      ++squares;
    }
  }
  return squares > 0 ? sum / squares : 1.0;
}

Image resized(const Image& image, Size size) {
  Image result{size, {}};
  result.rgba.reserve(4 * static_cast<std::size_t>(size.width) *
                      static_cast<std::size_t>(size.height));
  const auto channel = [&](int x, int y, int c) {
    const int column = std::clamp(x, 0, image.size.width - 1);
    const int row = std::clamp(y, 0, image.size.height - 1);
    return static_cast<double>(
        image.rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.size.width) +
                        static_cast<std::size_t>(column)) +
                   static_cast<std::size_t>(c)]);
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double at_x = (x + 0.5) * image.size.width / size.width - 0.5;
      const double at_y = (y + 0.5) * image.size.height / size.height - 0.5;
      const int left = static_cast<int>(std::floor(at_x)), top = static_cast<int>(std::floor(at_y));
      const double right_share = at_x - left, lower_share = at_y - top;
      for (int c = 0; c < 4; ++c) {
        const double upper =
            std::lerp(channel(left, top, c), channel(left + 1, top, c), right_share);
        const double lower =
            std::lerp(channel(left, top + 1, c), channel(left + 1, top + 1, c), right_share);
        result.rgba.push_back(
            static_cast<unsigned char>(std::lround(std::lerp(upper, lower, lower_share))));
      }
    }
  }
  return result;
}

}  // namespace clatter
