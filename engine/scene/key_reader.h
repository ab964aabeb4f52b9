#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"
#include "engine/scene/key_values.h"

namespace clatter {

/// Visitor that reads every key of a parsed scene file into its variable. The variable of an absent
/// key keeps its default. Throws UserError for a key that is missing, has the wrong type or is out
/// of range.
class KeyReader {
 public:
  /// `file` is the name in errors about missing keys.
  KeyReader(const toml::table& root, std::string file)
      : root_(root), table_(&root), file_(std::move(file)), otherwise_{file_, 0, 0} {}

  template <class T>
  void value(std::string_view key, T& value, Limits limits = {}, Presence presence = kOptional) {
    const toml::node* node = find(key, presence);
    if (!node) return;
    if (!read(*node, limits, value)) refuse(key, *node, allowed_values(value, limits));
  }

  /// A number that may be absent.
  template <class T>
  void value(std::string_view key, std::optional<T>& number, Limits limits,
             Presence presence = kOptional) {
    if (has(key)) value(key, number.emplace(), limits, presence);
  }

  template <class E, class Names>
  void choice(std::string_view key, E& chosen, const Names& names, Presence presence = kOptional) {
    const toml::node* node = find(key, presence);
    if (!node) return;
    chosen = named<E>(key, *node, names).front();
  }

  /// A choice that may be absent, also by the name "none".
  template <class E, class Names>
  void choice(std::string_view key, std::optional<E>& chosen, const Names& names) {
    const toml::node* node = find(key, kOptional);
    if (!node) return;
    chosen.reset();
    if (node->value<std::string_view>() != "none") choice(key, chosen.emplace(), names);
  }

  template <class E, class Names>
  void choice(std::string_view key, std::vector<E>& chosen, const Names& names) {
    const toml::node* node = find(key, kOptional);
    if (!node) return;
    const toml::array* list = node->as_array();
    if (!list) refuse(key, *node, "a list of names");
    for (const toml::node& item : *list) {
      for (const E one : named<E>(key, item, names)) {
        if (std::ranges::find(chosen, one) == chosen.end()) chosen.push_back(one);
      }
    }
  }

  template <class Visit>
  void table(std::string_view key, Visit visit) {
    const toml::node* node = find(key, kOptional);
    if (node && !node->is_table()) refuse(key, *node, "a table");
    KeyReader inner(*this);
    inner.table_ = node ? node->as_table() : nullptr;
    inner.prefix_ += std::string(key) + '.';
    visit(inner);
  }

  template <class T, class Visit>
  void table(std::string_view key, std::optional<T>& content, Visit visit) {
    if (has(key)) {
      table(key, [&](KeyReader& io) { visit(io, content.emplace()); });
    }
  }

  template <class T, class Visit>
  void list(std::string_view key, std::vector<T>& items, Visit visit) {
    const toml::node* node = find(key, kOptional);
    if (!node) return;
    const toml::array* tables = node->as_array();
    if (!tables || !(tables->empty() || tables->is_array_of_tables())) {
      refuse(key, *node, "tables [[" + path(key) + "]]");
    }
    for (const toml::node& item : *tables) {
      KeyReader inner = reader_of(key, item);
      visit(inner, items.emplace_back());
    }
  }

  /// Nested tables become dotted keys, unless they are inline.
  void settings(std::string_view key, std::vector<Override>& settings);

 private:
  bool has(std::string_view key) const { return table_ && table_->contains(key); }
  /// The key's value; nullptr if an optional key is absent.
  const toml::node* find(std::string_view key, Presence presence) const;
  std::string path(std::string_view key) const { return list_ + prefix_ + std::string(key); }
  Place place(std::string_view key) const;
  KeyReader reader_of(std::string_view list, const toml::node& item) const;
  [[noreturn]] void refuse(std::string_view key, const toml::node& node,
                           const std::string& wanted) const;
  [[noreturn]] void refuse_name(std::string_view key, const toml::node& node,
                                const std::vector<std::string>& names) const;

  /// The values of a name, at least one.
  template <class E, class Names>
  std::vector<E> named(std::string_view key, const toml::node& node, const Names& names) const {
    std::vector<E> values;
    std::vector<std::string> all;
    for (const auto& [name, value] : names) {
      if (node.value<std::string_view>() == name) values.push_back(value);
      if (all.empty() || all.back() != name) all.emplace_back(name);
    }
    if (values.empty()) refuse_name(key, node, all);
    return values;
  }

  // Each overload reads a node of its type within the limits; returns false if the node does not
  // fit.
  static bool read(const toml::node& node, Limits limits, double& value);
  static bool read(const toml::node& node, Limits limits, int& value);
  static bool read(const toml::node& node, Limits limits, bool& value);
  static bool read(const toml::node& node, Limits limits, std::string& value);
  static bool read(const toml::node& node, Limits limits, Vec2& value);
  static bool read(const toml::node& node, Limits limits, std::vector<Vec2>& points);
  static bool read(const toml::node& node, Limits limits, VecX& value);
  static bool read(const toml::node& node, Limits limits, std::vector<int>& value);
  static bool read(const toml::node& node, Limits limits, std::vector<double>& value);
  static bool read(const toml::node& node, Limits limits, std::vector<std::string>& texts);
  static bool read(const toml::node& node, Limits limits, ColourRange& range);
  static bool read(const toml::node& node, Limits limits, Rgb& colour);

  const toml::table& root_;
  const toml::table* table_;  // the current table; nullptr: absent, all defaults
  std::string list_;          // path of the list that contains the root, and a dot; or empty
  std::string prefix_;        // path of the table from the root, and a dot; empty at the root
  std::string file_;
  Place otherwise_;  // place for keys that are not in the file
};

}  // namespace clatter
