#include "engine/scene/key_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/text.h"

namespace clatter {

std::string value_text(double number) {
  const std::string text = number_text(number);
  if (std::isinf(number)) return text;
  // Without a point a large number would be an integer, and TOML limits integers to 2^63.
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string value_text(int number) {
  return std::to_string(number);
}

std::string value_text(bool flag) {
  return flag ? "true" : "false";
}

std::string value_text(const std::string& text) {
  return in_quotes(text);
}

template <class Numbers>
static std::string array_text(const Numbers& numbers) {
  std::string text;
  for (const auto& number : numbers) text += (text.empty() ? "[" : ", ") + value_text(number);
  return text + ']';
}

std::string value_text(const std::vector<std::string>& texts) {
  return texts.empty() ? "[]" : array_text(texts);
}

std::string value_text(const Vec2& vector) {
  return array_text(vector);
}

std::string value_text(const std::vector<Vec2>& points) {
  return points.empty() ? "[]" : array_text(points);
}

std::string value_text(const VecX& vector) {
  return array_text(vector);
}

std::string value_text(const std::vector<int>& numbers) {
  return array_text(numbers);
}

std::string value_text(const std::vector<double>& numbers) {
  return array_text(numbers);
}

std::string value_text(const ColourRange& range) {
  switch (range.kind) {
    case ColourRange::Auto:
      return in_quotes("auto");
    case ColourRange::Locked:
      return in_quotes("locked");
    case ColourRange::Given:
      return array_text(range.ends);
  }
  return "";
}

std::string value_text(const Rgb& colour) {
  return in_quotes(fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue));
}

std::string TomlWriter::path() const {
  std::string path;
  for (const std::string& part : path_) path += (path.empty() ? "" : ".") + part;
  return path;
}

static void append(std::string& list, const std::string& item) {
  list += (list.empty() ? "" : ", ") + item;
}

void TomlWriter::write(std::string_view key, const std::string& value) {
  if (!inline_.empty()) return append(inline_.back().text, std::string(key) + " = " + value);
  if (header_due_) {
    text_ += "\n[" + path() + "]\n";
    header_due_ = false;
  }
  text_ += std::string(key) + " = " + value + '\n';
}

void TomlWriter::open(std::string_view key) {
  if (in_item_) {
    inline_.push_back({std::string(key), ""});
  } else {
    path_.emplace_back(key);
    header_due_ = true;
  }
}

void TomlWriter::close() {
  if (in_item_) {
    const Inline table = inline_.back();
    inline_.pop_back();
    if (!table.text.empty()) write(table.key, "{ " + table.text + " }");
  } else {
    path_.pop_back();
    header_due_ = false;
  }
}

void TomlWriter::open_list(std::string_view key, bool) {
  if (in_item_) {
    inline_.push_back({std::string(key), ""});
  } else {
    path_.emplace_back(key);
  }
}

void TomlWriter::open_item() {
  if (in_item_) {
    inline_.emplace_back();
  } else {
    in_item_ = true;
    text_ += "\n[[" + path() + "]]\n";
  }
}

void TomlWriter::close_item() {
  if (inline_.empty()) {
    in_item_ = false;
  } else {
    const std::string table = inline_.back().text;
    inline_.pop_back();
    append(inline_.back().text, "{ " + table + " }");
  }
}

void TomlWriter::close_list() {
  if (in_item_) {
    const Inline list = inline_.back();
    inline_.pop_back();
    if (!list.text.empty()) write(list.key, '[' + list.text + ']');
  } else {
    path_.pop_back();
  }
}

void TomlWriter::settings(std::string_view key, const std::vector<Override>& settings) {
  if (settings.empty()) return;
  std::string list;
  for (const auto& [name, value] : settings) {
    list += (list.empty() ? "" : ", ") + in_quotes(name) + " = " + value;
  }
  write(key, "{ " + list + " }");
}

void JsonWriter::begin(std::string_view key) {
  if (!text_.empty() && text_.back() != '{') text_ += ", ";
  text_ += in_quotes(key) + ": ";
}

void JsonWriter::write(std::string_view key, const std::string& value) {
  begin(key);
  text_ += value == "inf" ? in_quotes(value) : value;  // JSON has no infinity
}

void JsonWriter::open(std::string_view key) {
  starts_.push_back(text_.size());
  begin(key);
  text_ += '{';
}

void JsonWriter::close() {
  if (text_.back() == '{') {
    text_.resize(starts_.back());
  } else {
    text_ += '}';
  }
  starts_.pop_back();
}

void JsonWriter::open_list(std::string_view key, bool empty) {
  starts_.push_back(text_.size());
  if (!empty) begin(key);
  if (!empty) text_ += '[';
}

void JsonWriter::open_item() {
  text_ += text_.back() == '[' ? "{" : ", {";
}

void JsonWriter::close_list() {
  if (text_.size() > starts_.back()) text_ += ']';
  starts_.pop_back();
}

void JsonWriter::settings(std::string_view key, const std::vector<Override>& settings) {
  if (settings.empty()) return;
  std::string list;
  for (const auto& [name, value] : settings) {
    list += (list.empty() ? "" : ", ") + in_quotes(name) + ": " + in_quotes(value);
  }
  write(key, '{' + list + '}');
}

}  // namespace clatter
