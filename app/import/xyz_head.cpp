#include "app/import/xyz_head.h"

#include <algorithm>
#include <cctype>

#include "engine/text.h"

namespace clatter {

static constexpr std::string_view kBlanks = " \t";
// Others are skipped.
static constexpr std::array<std::string_view, 6> kKeys = {"lattice",    "origin", "pbc",
                                                          "properties", "time",   "type_names"};

static std::string lower_case(std::string text) {
  for (char& letter : text) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

XyzHead::XyzHead(const TextLines& lines) : lines_(lines), rest_(lines.text()) {
  for (skip_blanks(); !rest_.empty(); skip_blanks()) {
    const bool bare = !rest_.starts_with('"');
    const std::string key = lower_case(taken_key());
    skip_blanks();
    if (!rest_.starts_with('=')) {  // a word of a comment
      if (std::ranges::find(kKeys, key) == kKeys.end()) continue;
      lines_.refuse("the key " + key + " has no value", "write " + key + "=VALUE");
    }
    if (bare && key.find_first_of("\"'{}[],\\") != key.npos) {
      lines_.refuse("the key " + quoted_start(key) + " has special characters",
                    "write it between double quotes");
    }
    rest_.remove_prefix(1);
    skip_blanks();
    const std::string value = taken_value();
    if (!rest_.empty() && kBlanks.find(rest_.front()) == kBlanks.npos) {
      lines_.refuse(
          "the value of " + quoted_start(key) + " does not end at its " + "quote or bracket",
          "write a blank behind it");
    }
    if (std::ranges::find(kKeys, key) == kKeys.end()) continue;
    if (!values_.emplace(key, value).second) {
      lines_.refuse("two values have the key " + key, "remove one of them");
    }
  }
}

void XyzHead::skip_blanks() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
}

// The text before `end`, in which a backslash precedes special characters.
std::string XyzHead::taken_text(char end) {
  std::string text;
  for (std::size_t k = 1; k < rest_.size(); ++k) {
    if (rest_[k] == end) {
      rest_.remove_prefix(k + 1);
      return text;
    }
    const bool escaped = rest_[k] == '\\' && k + 1 < rest_.size();
    if (escaped) ++k;
    text += escaped && rest_[k] == 'n' ? '\n' : rest_[k];
  }
  lines_.refuse(std::string("a ") + rest_.front() + " has no " + end, "close it");
}

// The elements of an array in brackets, which may contain arrays of one dimension.
std::string XyzHead::taken_array() {
  std::string elements;
  int depth = 0;
  do {
    if (rest_.empty()) lines_.refuse("a [ has no ]", "close it");
    const char next = rest_.front();
    if (next == '"' || next == '\'') {
      elements += taken_text(next);
      continue;
    }
    if (next == '[' && ++depth > 2) {
      lines_.refuse("arrays have at most two dimensions",
                    "write numbers in at most two pairs of brackets");
    }
    if (next == ']') --depth;
    elements += next == '[' || next == ']' ? ' ' : next;
    rest_.remove_prefix(1);
  } while (depth > 0);
  return elements;
}

std::string XyzHead::taken_key() {
  if (rest_.starts_with('"')) return taken_text('"');
  const std::string key(rest_.substr(0, rest_.find_first_of(" \t=")));
  rest_.remove_prefix(key.size());
  if (key.empty()) lines_.refuse("a value has no key", "write KEY=VALUE");
  return key;
}

std::string XyzHead::taken_value() {
  if (rest_.starts_with('"') || rest_.starts_with('\'')) return taken_text(rest_.front());
  if (rest_.starts_with('{')) return taken_text('}');
  if (rest_.starts_with('[')) return taken_array();
  const std::string value(rest_.substr(0, rest_.find_first_of(kBlanks)));
  rest_.remove_prefix(value.size());
  return value;
}

std::string XyzHead::text(const std::string& key) const {
  const auto value = values_.find(key);
  return value == values_.end() ? "" : value->second;
}

std::vector<std::string> XyzHead::words(const std::string& key) const {
  std::string value = text(key);
  std::ranges::replace(value, ',', ' ');
  const LineWords words = words_of(value);
  return {words.begin(), words.end()};
}

std::vector<double> XyzHead::numbers(const std::string& key, std::size_t count) const {
  std::vector<double> numbers;
  for (const std::string& word : words(key)) numbers.push_back(lines_.real(word));
  if (numbers.size() == count) return numbers;
  lines_.refuse(
      key + " has " + counted(numbers.size(), "number") + " instead of " + std::to_string(count),
      "give all of them, as in \"1 0 0\"");
}

std::array<bool, 3> XyzHead::truths(const std::string& key) const {
  const std::vector<std::string> all = words(key);
  if (all.size() != 3) {
    lines_.refuse(key + " has " + counted(all.size(), "value") + " instead of 3",
                  "write, say, " + key + "=\"T T F\"");
  }
  std::array<bool, 3> truths{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string word = lower_case(all[k]);
    truths[k] = word == "t" || word == "true" || word == "1";
    if (truths[k] || word == "f" || word == "false" || word == "0") continue;
    lines_.refuse(quoted_start(all[k]) + " is neither true nor false",
                  "write, say, " + key + "=\"T T F\"");
  }
  return truths;
}

}  // namespace clatter
