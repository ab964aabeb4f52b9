#include "engine/scene/scene_differences.h"

#include <map>
#include <sstream>

#include "engine/scene/scene_document.h"

namespace clatter {

using Values = std::map<std::string, std::string>;

static void collect(const toml::table& table, const std::string& prefix, Values& values) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, path + '.', values);
    } else {
      std::ostringstream text;
      node.visit([&text](const auto& value) { text << value; });
      values[path] = text.str();
    }
  }
}

static Values values_of(std::string_view text, const std::string& file) {
  Values values;
  collect(parse_document(text, file), "", values);
  return values;
}

std::vector<KeyDifference> differences(std::string_view before, std::string_view now,
                                       const std::string& file) {
  std::map<std::string, KeyDifference> all;
  for (const auto& [key, value] : values_of(before, file)) all[key].before = value;
  for (const auto& [key, value] : values_of(now, "")) all[key].now = value;
  std::vector<KeyDifference> different;
  for (auto& [key, values] : all) {
    if (values.before != values.now) different.push_back({key, values.before, values.now});
  }
  return different;
}

}  // namespace clatter
