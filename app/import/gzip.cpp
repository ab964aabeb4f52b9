#include "app/import/gzip.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <memory>
#include <string_view>

#include "engine/error.h"
#include "engine/system/read_file.h"

namespace clatter {

static constexpr std::string_view kGzipMagic = "\x1f\x8b";
static constexpr std::size_t kLargestText = 4'000'000'000;  // bytes

bool is_gzip(const std::filesystem::path& path) {
  std::array<char, kGzipMagic.size()> begin{};
  std::ifstream file(path, std::ios::binary);
  return file.read(begin.data(), begin.size()) &&
         kGzipMagic == std::string_view(begin.data(), begin.size());
}

std::string gunzipped(const std::filesystem::path& path) {
  constexpr const char* kDecompress = "decompress it with gunzip";
  const std::string bytes = read_file(path.string(), kLargestText, kDecompress);
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string text(std::min(4 * bytes.size(), kLargestText), '\0');
  std::size_t written = 0;
  for (std::string_view rest = bytes; !rest.empty();) {
    std::size_t taken = 0, given = 0;
    const libdeflate_result result =
        libdeflate_gzip_decompress_ex(decompressor.get(), rest.data(), rest.size(), &text[written],
                                      text.size() - written, &taken, &given);
    if (result == LIBDEFLATE_INSUFFICIENT_SPACE) {
      if (text.size() == kLargestText) {
        throw UserError({path.string()}, "the compressed file has more than 4 GB", kDecompress);
      }
      text.resize(std::min(2 * text.size(), kLargestText));
      continue;
    }
    if (result != LIBDEFLATE_SUCCESS) {
      throw UserError({path.string()}, "the compressed file is damaged or cut off",
                      "give a complete file");
    }
    written += given;
    rest.remove_prefix(taken);
  }
  text.resize(written);
  return text;
}

}  // namespace clatter
