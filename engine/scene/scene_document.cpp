#include "engine/scene/scene_document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

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

/// Removes the keys of a table that contradict new ones: the number of particles has three keys,
/// their mass two.
static void remove_rivals(toml::table& into, const toml::table& changes) {
  using Keys = std::vector<const char*>;
  for (const Keys& rivals :
       {Keys{"count", "area_fraction", "volume_fraction"}, Keys{"mass", "density"}}) {
    const auto is_set = [&](const char* key) { return changes.contains(key); };
    if (std::ranges::none_of(rivals, is_set)) continue;
    for (const char* key : rivals) into.erase(key);
  }
}

constexpr std::string_view kSpeciesList = "species";
constexpr std::string_view kPairList = "pair";

/// The item of [[species]] with a name; nullptr without one.
static toml::table* species_table(toml::table& root, std::string_view name) {
  toml::array* species = root[kSpeciesList].as_array();
  if (!species) return nullptr;
  for (toml::node& item : *species) {
    toml::table* table = item.as_table();
    if (table && (*table)["name"].value<std::string_view>() == name) return table;
  }
  return nullptr;
}

/// The item of [[pair]] of two species; nullptr without one.
static toml::table* pair_table(toml::table& root, std::string_view first, std::string_view second) {
  toml::array* pairs = root[kPairList].as_array();
  if (!pairs) return nullptr;
  for (toml::node& item : *pairs) {
    toml::table* table = item.as_table();
    const toml::array* names = table ? (*table)["species"].as_array() : nullptr;
    if (!names || names->size() != 2) continue;
    const auto a = (*names)[0].value<std::string_view>(), b = (*names)[1].value<std::string_view>();
    if ((a == first && b == second) || (a == second && b == first)) return table;
  }
  return nullptr;
}

/// Lists of fixtures, whose items have names by their place unless they have their own.
constexpr std::array<std::string_view, 2> kFixtureLists = {"obstacle", "partition"};

/// The item of a list of fixtures with a name; nullptr without one.
static toml::table* fixture_table(toml::table& root, std::string_view list, std::string_view name) {
  toml::array* items = root[list].as_array();
  if (!items) return nullptr;
  for (std::size_t k = 0; k < items->size(); ++k) {
    toml::table* table = (*items)[k].as_table();
    if (!table) continue;
    const std::string by_place = std::string(list) + '_' + std::to_string(k + 1);
    if ((*table)["name"].value_or(std::string_view(by_place)) == name) return table;
  }
  return nullptr;
}

std::vector<std::string> species_names(const toml::table& root) {
  std::vector<std::string> names;
  if (const toml::array* species = root[kSpeciesList].as_array()) {
    for (const toml::node& item : *species) {
      const toml::table* table = item.as_table();
      names.push_back(table ? (*table)["name"].value_or(std::string()) : "");
    }
  }
  return names;
}

void refuse_species(const Place& place, std::string_view name,
                    const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& one : names) all += (all.empty() ? "" : ", ") + one;
  const std::string near(near_miss(name, names));
  throw UserError(place, "there is no species " + in_quotes(name),
                  all.empty()     ? "add [[species]] with this name"
                  : !near.empty() ? "did you mean " + in_quotes(near) + "?"
                                  : "the species are " + all);
}

/// The tables of an override whose path has a name after its first key. Throws for other values.
static std::vector<std::pair<std::string, toml::table*>> named_tables(toml::table& changes,
                                                                      const Place& place,
                                                                      const char* wanted) {
  std::vector<std::pair<std::string, toml::table*>> tables;
  for (auto&& [name, node] : changes) {
    toml::table* table = node.as_table();
    if (!table) throw UserError(place, "the path has no key of a species", wanted);
    tables.emplace_back(std::string(name.str()), table);
  }
  return tables;
}

/// Applies and removes the changes of obstacle.NAME.KEY and partition.NAME.KEY.
static void replace_in_fixtures(toml::table& root, toml::table& changes, const Place& place) {
  for (const std::string_view list : kFixtureLists) {
    toml::table* items = changes[list].as_table();
    if (!items) continue;
    for (auto&& [name, node] : *items) {
      toml::table* values = node.as_table();
      const std::string path = std::string(list) + ".NAME.KEY";
      if (!values) throw UserError(place, "the path has no key of a fixture", "write " + path);
      toml::table* item = fixture_table(root, list, name.str());
      if (!item) {
        throw UserError(
            place, "there is no " + std::string(list) + ' ' + in_quotes(name.str()),
            "give the name of one, or " + std::string(list) + "_1 for the first without a name");
      }
      replace(*item, *values);
    }
    changes.erase(list);
  }
}

/// Applies and removes the changes of species.NAME.KEY and pair.NAME.NAME.KEY.
static void replace_in_lists(toml::table& root, toml::table& changes, const Place& place) {
  const auto require = [&](const std::string& name) {
    if (!species_table(root, name)) refuse_species(place, name, species_names(root));
  };
  if (toml::table* species = changes[kSpeciesList].as_table()) {
    for (const auto& [name, values] : named_tables(*species, place, "write species.NAME.KEY")) {
      require(name);
      toml::table& item = *species_table(root, name);
      remove_rivals(item, *values);
      replace(item, *values);
    }
    changes.erase(kSpeciesList);
  }
  if (toml::table* pairs = changes[kPairList].as_table()) {
    constexpr const char* kWanted = "write pair.NAME.NAME.KEY";
    for (const auto& [first, inner] : named_tables(*pairs, place, kWanted)) {
      require(first);
      for (const auto& [second, values] : named_tables(*inner, place, kWanted)) {
        require(second);
        if (!root[kPairList].is_array()) root.insert_or_assign(kPairList, toml::array());
        toml::table* item = pair_table(root, first, second);
        if (!item) {
          toml::array& list = *root[kPairList].as_array();
          list.push_back(toml::table{{"species", toml::array{first, second}}});
          item = list.back().as_table();
        }
        if (values->contains("species")) {
          throw UserError(place, "the species of a pair cannot change",
                          "write pair.NAME.NAME.KEY with the names of the other pair");
        }
        replace(*item, *values);
      }
    }
    changes.erase(kPairList);
  }
}

void apply_override(toml::table& root, const Override& change) {
  toml::table changes = parse_override(change);
  const Place place{std::string(kOverrideFile) + change.key};
  replace_in_lists(root, changes, place);
  replace_in_fixtures(root, changes, place);
  toml::table* particles = root["particles"].as_table();
  const toml::table* set = changes["particles"].as_table();
  if (particles && set) remove_rivals(*particles, *set);
  replace(root, changes);
}

const toml::node* node_at(toml::table& root, std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  const bool of_species = parts.size() == 3 && parts[0] == kSpeciesList;
  const bool of_pair = parts.size() == 4 && parts[0] == kPairList;
  if (parts.size() >= 3 && std::ranges::find(kFixtureLists, parts[0]) != kFixtureLists.end()) {
    toml::table* item = fixture_table(root, parts[0], parts[1]);
    const std::size_t rest = parts[0].size() + parts[1].size() + 2;
    return item ? item->at_path(path.substr(rest)).node() : nullptr;
  }
  if (!of_species && !of_pair) return root.at_path(path).node();
  const toml::table* table =
      of_species ? species_table(root, parts[1]) : pair_table(root, parts[1], parts[2]);
  return table ? table->get(parts.back()) : nullptr;
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
    const auto is_in = [&](const char* table) { return one.starts_with(table); };
    if (is_in("pair.") || is_in("species.") || is_in("piston.")) continue;
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
