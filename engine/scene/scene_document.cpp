#include "engine/scene/scene_document.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "engine/text.h"

namespace clatter {

constexpr std::string_view kOverrideFile =
    "--set ";  // followed by the key: the "file" of an override

/// Index of the last byte of the string that opens at `start`; of an unclosed string, the end of
/// the line.
static std::size_t end_of_string(std::string_view text, std::size_t start) {
  const char quote = text[start];
  const std::string triple(3, quote);
  const bool multiline = text.substr(start, 3) == triple;
  const std::string_view delimiter = std::string_view(triple).substr(0, multiline ? 3 : 1);
  for (std::size_t i = start + delimiter.size(); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text.substr(i, delimiter.size()) == delimiter) {
      i += delimiter.size() - 1;
      while (multiline && i + 1 < text.size() && text[i + 1] == quote) ++i;  // quotes at its end
      return i;
    } else if (!multiline && text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

/// Throws at a dotted key with too many parts. The parser limits the depth of arrays and inline
/// tables, but not of dotted keys. It frees nested tables recursively and could overflow the stack.
static void refuse_deep_keys(std::string_view text, const std::string& file) {
  constexpr int kMaxDots = 16;
  int dots = 0;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t start = i;
    if (text[i] == '#') {
      i = std::min(text.find('\n', i), text.size() - 1);
    } else if (text[i] == '"' || text[i] == '\'') {
      i = std::min(end_of_string(text, i), text.size() - 1);
    }
    if (text[i] == '.' && ++dots > kMaxDots) {
      throw UserError({file, line, 0}, "a key has more than " + std::to_string(kMaxDots) + " dots",
                      "no key of a scene is that deep");
    }
    if (std::string_view("=,[]{}\n").find(text[i]) != std::string_view::npos) dots = 0;
    line += static_cast<int>(std::count(&text[start], &text[i] + 1, '\n'));
  }
}

toml::table parse_document(std::string_view text, const std::string& file) {
  refuse_deep_keys(text, file);
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw UserError({file, static_cast<int>(at.line), static_cast<int>(at.column)},
                    std::string(error.description()),
                    "a scene is a TOML file, see https://toml.io");
  }
}

/// The override as a separate document. A value that is not TOML becomes a string, so that a shell
/// user need not quote twice.
static toml::table parse_override(const Override& change) {
  const std::string file = std::string(kOverrideFile) + change.key;
  const bool bare = std::ranges::all_of(change.key, [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  });
  if (bare) {
    for (const std::string& value : {change.value, in_quotes(change.value)}) {
      try {
        return parse_document(change.key + " = " + value, file);
      } catch (const UserError&) {
        // Tries again with the value as a string; an invalid key fails both times.
      }
    }
  }
  throw UserError({file}, in_quotes(change.key) + " cannot be a key",
                  "write, say, particles.count=500");
}

static void replace(toml::table& into, toml::table& changes) {
  for (auto&& [key, value] : changes) {
    toml::table* inner = into[key].as_table();
    toml::table* change = value.as_table();
    if (inner && change && !change->is_inline()) {
      replace(*inner, *change);
    } else {
      into.erase(key);  // with its key, which has the place
      value.visit([&into, &key = key](auto& node) { into.insert(key, std::move(node)); });
    }
  }
}

void apply_override(toml::table& root, const Override& change) {
  toml::table changes = parse_override(change);
  // Each of these keys sets the number of particles, so each replaces the others.
  constexpr std::array<const char*, 3> kNumbers = {"count", "area_fraction", "volume_fraction"};
  toml::table* particles = root["particles"].as_table();
  const toml::table* set = changes["particles"].as_table();
  const bool sets_number =
      set && std::ranges::any_of(kNumbers, [&](const char* key) { return set->contains(key); });
  if (particles && sets_number) {
    for (const char* key : kNumbers) particles->erase(key);
  }
  replace(root, changes);
}

bool from_override(const Place& place) {
  return place.file.starts_with(kOverrideFile);
}

/// Place of a key, or of a table's header.
static Place place_of(const toml::key& key, const toml::node& value) {
  const toml::source_region& source = value.is_table() ? value.source() : key.source();
  const std::string file = source.path ? *source.path : "";
  if (from_override({file})) return {file};
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Place place_of(const toml::node& node, const std::string& file) {
  const toml::source_position at = node.source().begin;
  return {file, static_cast<int>(at.line), static_cast<int>(at.column)};
}

/// Advice for an unknown key. `prefix` is the length of its table's part of the path.
static std::string advice_on(std::string_view path, std::size_t prefix,
                             const std::vector<std::string>& known) {
  if (path == "disks") return "it is called 'particles' now: write particles in place of disks";
  if (path == "particles.area_fraction") return "a box of three sides has a 'volume_fraction'";
  if (path == "particles.volume_fraction") return "a box of two sides has an 'area_fraction'";
  const std::string_view key = path.substr(prefix);
  std::vector<std::string> siblings;
  std::string all;
  for (const std::string& one : known) {
    if (!one.starts_with(path.substr(0, prefix)) || one.find('.', prefix) != one.npos) continue;
    siblings.push_back(one.substr(prefix));
    all += (all.empty() ? "" : ", ") + siblings.back();
  }
  if (const auto near = near_miss(key, siblings); !near.empty()) {
    return "did you mean '" + std::string(near) + "'?";
  }
  for (const std::string& one : known) {
    if (one.ends_with('.' + std::string(key))) return "did you mean '" + one + "'?";
  }
  return "the keys here are " + all;
}

static void refuse_unknown_keys(const toml::table& table, const std::string& prefix,
                                const std::vector<std::string>& known);

// Checks tables and lists of tables, except tables that may have any key.
static void refuse_unknown_keys_within(const toml::node& node, const std::string& prefix,
                                       const std::vector<std::string>& known) {
  const auto listed = [&](const std::string& key) { return key.starts_with(prefix); };
  if (std::ranges::none_of(known, listed)) return;
  if (const toml::table* table = node.as_table()) refuse_unknown_keys(*table, prefix, known);
  if (!node.is_array_of_tables()) return;
  for (const toml::node& item : *node.as_array()) {
    refuse_unknown_keys(*item.as_table(), prefix, known);
  }
}

static void refuse_unknown_keys(const toml::table& table, const std::string& prefix,
                                const std::vector<std::string>& known) {
  for (auto&& [key, value] : table) {
    const std::string path = prefix + std::string(key.str());
    const bool dotted = key.str().find('.') != std::string_view::npos;  // one quoted key, no path
    if (dotted || std::ranges::find(known, path) == known.end()) {
      const std::string name = in_quotes(key.str());
      throw UserError(place_of(key, value), "unknown key '" + name.substr(1, name.size() - 2) + "'",
                      advice_on(path, prefix.size(), known));
    }
    refuse_unknown_keys_within(value, path + '.', known);
  }
}

void refuse_unknown_keys(const toml::table& root, const std::vector<std::string>& known) {
  refuse_unknown_keys(root, "", known);
}

Place place_of(const toml::table& root, std::string_view path, const std::string& file) {
  Place place = {file};
  const toml::table* table = &root;
  while (table && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const auto entry = table->find(path.substr(0, dot));
    if (entry == table->end()) break;
    place = place_of(entry->first, entry->second);
    table = entry->second.as_table();
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return place;
}

std::string toml_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) {
    const std::string text = number_text(number->get());
    const bool whole = text.find_first_not_of("-0123456789") == text.npos;
    return whole ? text + ".0" : text;
  }
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* text = node.as_string()) return in_quotes(text->get());
  if (const auto* array = node.as_array()) {
    std::string list;
    for (const toml::node& item : *array) list += (list.empty() ? "" : ", ") + toml_text(item);
    return '[' + list + ']';
  }
  const auto* table = node.as_table();
  if (!table) return "a date";
  std::string list;
  for (const auto& [key, item] : *table) {
    list += (list.empty() ? "" : ", ") + in_quotes(key.str()) + " = " + toml_text(item);
  }
  return '{' + list + '}';
}

}  // namespace clatter
