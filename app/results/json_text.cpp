#include "app/results/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace clatter {

using Json = nlohmann::ordered_json;

// Text between the brackets of an object or a list, one element per line.
template <class Element>
static std::string lines(const Json& json, std::size_t depth, const Element& element) {
  const std::string indent(depth, ' ');
  std::string text;
  for (const auto& [key, value] : json.items()) {
    text += (text.empty() ? "\n " : ",\n ") + indent + element(key, value);
  }
  return text + '\n' + indent;
}

static std::string text_at(const Json& json, std::size_t depth) {
  if (json.is_object() && !json.empty()) {
    return '{' +
           lines(json, depth,
                 [&](const std::string& key, const Json& value) {
                   return Json(key).dump() + ": " + text_at(value, depth + 1);
                 }) +
           '}';
  }
  if (json.is_array() && std::ranges::any_of(json, &Json::is_structured)) {
    return '[' +
           lines(json, depth,
                 [&](const std::string&, const Json& value) { return text_at(value, depth + 1); }) +
           ']';
  }
  return json.dump();
}

std::string json_text(const Json& json) {
  return text_at(json, 0);
}

}  // namespace clatter
