#include "engine/system/checksum.h"

#include <libdeflate.h>

#include <fstream>
#include <vector>

namespace clatter {

std::uint32_t checksum(std::string_view bytes) {
  return continued_checksum(0, bytes);
}

std::uint32_t continued_checksum(std::uint32_t before, std::string_view bytes) {
  return libdeflate_crc32(before, bytes.data(), bytes.size());
}

std::optional<std::uint32_t> checksum_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> bytes(1 << 20);
  std::uint32_t sum = 0;
  while (stream) {
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    sum = libdeflate_crc32(sum, bytes.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.eof()) return std::nullopt;
  return sum;
}

}  // namespace clatter
