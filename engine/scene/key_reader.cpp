#include "engine/scene/key_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/scene/scene_document.h"
#include "engine/text.h"

namespace clatter {

/// The value for a message; long values are abbreviated.
static std::string shown(const toml::node& node) {
  if (node.is_table()) return "this table";
  constexpr std::size_t kLongest = 40;
  const std::string text = toml_text(node);
  if (text.size() <= kLongest) return text;
  return node.is_array() ? "this long array" : "this long text";
}

const toml::node* KeyReader::find(std::string_view key, Presence presence) const {
  const toml::node* node = table_ ? table_->get(key) : nullptr;
  if (node && presence.kind == Presence::Forbidden) {
    throw UserError(place(key), "'" + path(key) + "' " + presence.reason, presence.advice);
  }
  if (!node && presence.kind == Presence::Required) {
    throw UserError(place(key), "'" + path(key) + "' is missing", "give it a value");
  }
  return node;
}

Place KeyReader::place(std::string_view key) const {
  const Place found = place_of(root_, prefix_ + std::string(key), file_);
  return found.line > 0 || from_override(found) ? found : otherwise_;
}

KeyReader KeyReader::reader_of(std::string_view list, const toml::node& item) const {
  KeyReader inner(*item.as_table(), file_);
  inner.list_ = path(list) + '.';
  inner.otherwise_ = place_of(item, file_);
  return inner;
}

static void flatten(const toml::table& table, const std::string& prefix,
                    std::vector<Override>& settings) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    const toml::table* inner = node.as_table();
    if (inner && !inner->is_inline()) {
      flatten(*inner, path + '.', settings);
    } else {
      settings.push_back({path, toml_text(node)});
    }
  }
}

void KeyReader::settings(std::string_view key, std::vector<Override>& settings) {
  const toml::node* node = find(key, kOptional);
  if (!node) return;
  if (!node->is_table()) refuse(key, *node, "a table of keys and values");
  flatten(*node->as_table(), "", settings);
}

void KeyReader::refuse(std::string_view key, const toml::node& node,
                       const std::string& wanted) const {
  throw UserError(place(key), "'" + path(key) + "' cannot be " + shown(node), "give " + wanted);
}

void KeyReader::refuse_name(std::string_view key, const toml::node& node,
                            const std::vector<std::string>& names) const {
  const std::string name(node.value_or(std::string_view()));
  std::string in_plane = name;
  std::ranges::replace(in_plane, 'z', 'y');
  if (in_plane != name && std::ranges::find(names, in_plane) != names.end()) {
    throw UserError(place(key),
                    "'" + path(key) + "' cannot be " + shown(node) + ": the box has no z axis",
                    "give one along x or y");
  }
  const std::string_view near = near_miss(name, names);
  std::string wanted;
  for (const std::string& name : names) wanted += (wanted.empty() ? "" : ", ") + in_quotes(name);
  if (!near.empty()) wanted += "; did you mean " + in_quotes(near) + "?";
  refuse(key, node, (names.size() > 1 ? "one of " : "") + wanted);
}

/// Accepts integers too, because users write 20 for 20.0.
static std::optional<double> number_in(const toml::node& node, Limits limits) {
  double number = 0.0;
  if (const auto* whole = node.as_integer()) {
    number = static_cast<double>(whole->get());
  } else if (const auto* real = node.as_floating_point()) {
    number = real->get();
  } else {
    return std::nullopt;
  }
  return limits.allow(number) ? std::optional(number + 0.0) : std::nullopt;  // no -0
}

/// An integer within the limits that fits an int.
static std::optional<int> whole_number_in(const toml::node& node, Limits limits) {
  const auto* whole = node.as_integer();
  if (!whole || !std::in_range<int>(whole->get()) || !number_in(node, limits)) return std::nullopt;
  return static_cast<int>(whole->get());
}

/// The numbers of an array of `size`; absent for any other node.
static std::optional<VecX> numbers_in(const toml::node& node, Limits limits, Eigen::Index size) {
  const toml::array* array = node.as_array();
  if (!array || static_cast<Eigen::Index>(array->size()) != size) return std::nullopt;
  VecX numbers(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto number = number_in((*array)[static_cast<std::size_t>(k)], limits);
    if (!number) return std::nullopt;
    numbers[k] = *number;
  }
  return numbers;
}

bool KeyReader::read(const toml::node& node, Limits limits, double& value) {
  const auto number = number_in(node, limits);
  value = number.value_or(value);
  return number.has_value();
}

bool KeyReader::read(const toml::node& node, Limits limits, int& value) {
  const auto number = whole_number_in(node, limits);
  value = number.value_or(value);
  return number.has_value();
}

bool KeyReader::read(const toml::node& node, Limits, bool& value) {
  if (!node.is_boolean()) return false;
  value = node.as_boolean()->get();
  return true;
}

bool KeyReader::read(const toml::node& node, Limits, std::string& value) {
  if (!node.is_string()) return false;
  value = node.as_string()->get();
  return true;
}

bool KeyReader::read(const toml::node& node, Limits limits, Vec2& value) {
  const auto numbers = numbers_in(node, limits, 2);
  if (!numbers) return false;
  value = *numbers;
  return true;
}

// The limits are those of the coordinates.
bool KeyReader::read(const toml::node& node, Limits limits, std::vector<Vec2>& points) {
  const toml::array* array = node.as_array();
  if (!array) return false;
  points.clear();
  for (const toml::node& item : *array) {
    if (!read(item, limits, points.emplace_back())) return false;
  }
  return true;
}

// Requires as many numbers as the default has: the dimension of the scene. Without a default two or
// three.
bool KeyReader::read(const toml::node& node, Limits limits, VecX& value) {
  const bool in_space = node.is_array() && node.as_array()->size() == 3;
  const auto numbers = numbers_in(node, limits, value.size() > 0 ? value.size() : in_space ? 3 : 2);
  if (!numbers) return false;
  value = *numbers;
  return true;
}

bool KeyReader::read(const toml::node& node, Limits limits, std::vector<int>& value) {
  const toml::array* array = node.as_array();
  if (!array || array->size() != value.size()) return false;
  for (std::size_t k = 0; k < value.size(); ++k) {
    const auto number = whole_number_in((*array)[k], limits);
    if (!number) return false;
    value[k] = *number;
  }
  return true;
}

bool KeyReader::read(const toml::node& node, Limits limits, std::vector<double>& value) {
  const auto numbers = numbers_in(node, limits, static_cast<Eigen::Index>(value.size()));
  if (!numbers) return false;
  value.assign(numbers->begin(), numbers->end());
  return true;
}

// The limits are those of the number of texts.
bool KeyReader::read(const toml::node& node, Limits limits, std::vector<std::string>& texts) {
  const toml::array* array = node.as_array();
  if (!array || !limits.allow(static_cast<double>(array->size()))) return false;
  texts.clear();
  for (const toml::node& item : *array) {
    if (!item.is_string()) return false;
    texts.push_back(item.as_string()->get());
  }
  return true;
}

bool KeyReader::read(const toml::node& node, Limits limits, ColourRange& range) {
  const auto name = node.value<std::string_view>();
  const auto ends = numbers_in(node, limits, 2);
  if (name == "auto") {
    range = {ColourRange::Auto};
  } else if (name == "locked") {
    range = {ColourRange::Locked};
  } else if (ends && (*ends)[1] - (*ends)[0] >= ColourRange::kLeastWidth) {
    range = {ColourRange::Given, {(*ends)[0], (*ends)[1]}};
  } else {
    return false;
  }
  return true;
}

bool KeyReader::read(const toml::node& node, Limits, Rgb& colour) {
  const auto text = node.value<std::string_view>();
  if (!text || text->size() != 7 || text->front() != '#') return false;
  std::uint8_t* const channels[] = {&colour.red, &colour.green, &colour.blue};
  for (std::size_t i = 0; i < 3; ++i) {
    const char* begin = text->data() + 1 + 2 * i;
    if (std::from_chars(begin, begin + 2, *channels[i], 16).ptr != begin + 2) return false;
  }
  return true;
}

}  // namespace clatter
