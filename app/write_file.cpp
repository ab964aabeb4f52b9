#include "app/write_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "engine/error.h"

namespace clatter {

void write_file(const std::filesystem::path& path, std::string_view text) {
  const std::filesystem::path part = path.string() + ".part";
  std::FILE* file = std::fopen(part.c_str(), "wb");
  bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file) written = std::fclose(file) == 0 && written;
  if (written && std::rename(part.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(part.c_str());
  throw RunError("cannot write " + path.string() + ": " + reason);
}

void require_folder_of(const std::filesystem::path& path, const char* flag) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (std::filesystem::is_directory(folder)) return;
  throw UserError({flag, 0, 0}, "there is no folder " + folder.string(),
                  "make it first, or name a file elsewhere");
}

}  // namespace clatter
