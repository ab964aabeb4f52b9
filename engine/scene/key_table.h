#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace clatter {

/// The commands that run a gas.
inline constexpr std::string_view kRunCommands = "view render measure";

/// A key of the scene file with its documentation.
struct Key {
  std::string_view name;
  std::string_view unit;     ///< in the letters of kUnits; "1": dimensionless; empty: no number
  std::string_view meaning;  ///< in sentences
  std::string_view commands = {};  ///< that read it, separated by blanks; empty: as the table

  constexpr operator std::string_view() const { return name; }
};

/// The documentation of all keys of one table of the scene file.
template <std::size_t N>
struct KeyTable {
  std::string_view commands;  ///< that read the keys, separated by blanks
  std::array<Key, N> keys;

  /// The row of a key. A key without a row does not compile.
  consteval Key at(std::string_view name) const {
    for (Key key : keys) {
      if (key.name != name) continue;
      if (key.meaning.empty()) throw "a key without a meaning";
      if (key.commands.empty()) key.commands = commands;
      return key;
    }
    throw "a key without a row";
  }
};

/// Makes a table from the commands and the rows.
template <std::size_t N>
consteval KeyTable<N> key_table(std::string_view commands, const Key (&rows)[N]) {
  return {commands, std::to_array(rows)};
}

}  // namespace clatter
