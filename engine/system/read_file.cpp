#include "engine/system/read_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/error.h"

namespace clatter {

std::string read_file(const std::string& path, std::size_t largest, const std::string& wanted) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes;
  // Reads in growing pieces, because pipes and devices have no size.
  for (std::size_t piece = 1 << 16; file && bytes.size() <= largest; piece *= 2) {
    const std::size_t before = bytes.size();
    bytes.resize(std::min(before + piece, largest + 1));
    file.read(&bytes[before], static_cast<std::streamsize>(bytes.size() - before));
    bytes.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  std::error_code ignored;
  if (!file.is_open() && !std::filesystem::exists(path, ignored)) {
    throw UserError({path}, "there is no such file", "check the name");
  }
  if (file.bad() || (file.fail() && !file.eof())) {
    throw UserError({path}, "the file cannot be read", "check its permissions");
  }
  if (bytes.size() > largest) {
    throw UserError(
        {path}, "the file is larger than " + std::to_string(largest / 1'000'000) + " MB", wanted);
  }
  return bytes;
}

}  // namespace clatter
