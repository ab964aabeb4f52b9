#include "engine/scene/scene_differences.h"

#include <map>
#include <sstream>
#include <utility>

#include "engine/scene/scene_document.h"

namespace clatter {

using Values = std::map<std::string, std::string>;

// The path of an item of [[species]] or [[pair]], as in overrides; empty for other lists.
static std::string item_path(std::string_view list, const toml::table& item) {
  if (list == "species") return "species." + item["name"].value_or(std::string());
  const toml::array* names = list == "pair" ? item["species"].as_array() : nullptr;
  if (!names || names->size() != 2) return {};
  std::string first = (*names)[0].value_or(std::string());
  std::string second = (*names)[1].value_or(std::string());
  if (second < first) std::swap(first, second);
  return "pair." + first + '.' + second;
}

static void collect(const toml::table& table, const std::string& prefix, Values& values) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    const bool is_named = prefix.empty() && (path == "species" || path == "pair");
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, path + '.', values);
    } else if (is_named && node.is_array_of_tables()) {
      for (const toml::node& item : *node.as_array()) {
        const std::string item_prefix = item_path(path, *item.as_table()) + '.';
        collect(*item.as_table(), item_prefix, values);
        if (path == "pair") values.erase(item_prefix + "species");  // is in the path
      }
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
