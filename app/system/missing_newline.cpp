#include "app/system/missing_newline.h"

#include <cstdio>
#include <fstream>

namespace clatter {

void note_missing_newline(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return;
  std::ifstream input(file, std::ios::binary | std::ios::ate);
  if (input.tellg() <= 0) return;
  input.seekg(-1, std::ios::end);
  if (input.get() == '\n') return;
  std::fprintf(stderr,
               "note: %s ends without a newline; if it was cut off, its last number is wrong\n",
               file.c_str());
}

}  // namespace clatter
