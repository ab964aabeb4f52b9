#include "app/system/page_parts.h"

#include "engine/error.h"

namespace clatter {

void replace_part(std::string& page, const std::string& file, const std::string& name,
                  std::string_view text) {
  const std::string begin = "<!-- " + name + " -->\n", end = "<!-- end of " + name + " -->";
  const std::size_t from = page.find(begin);
  const std::size_t to = page.find(end, from == std::string::npos ? page.size() : from);
  if (to == std::string::npos) {
    throw UserError({"--markdown", 0, 0}, file + " has no part for the " + name,
                    "add the lines <!-- " + name + " --> and " + end);
  }
  const std::size_t first = from + begin.size();
  page.replace(first, to - first, text);
}

}  // namespace clatter
