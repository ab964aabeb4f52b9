#pragma once

#include <string>
#include <vector>

#include "engine/scene/key_table.h"

namespace clatter {

/// The documentation of one key. Unit, meaning and commands come from the key table; the rest
/// follows from the code that reads scenes.
struct KeyDoc {
  std::string table;  ///< "particles.start"; empty: the top of the file
  Key key;
  std::string initial;               ///< default as TOML, or "none"; empty: the key is required
  std::string sphere_initial;        ///< default for spheres; empty: the same
  std::string values;                ///< allowed values in words; empty with choices
  std::string sphere_values;         ///< for spheres; empty: the same
  std::vector<std::string> choices;  ///< names that the key allows
  std::vector<std::string> sphere_choices;  ///< further names, for spheres
  std::string conditions = {};              ///< sentences about its presence; empty: always allowed
  bool changes_live = false;                ///< whether [[change]] may set it

  /// The full dotted path.
  std::string path() const { return (table.empty() ? "" : table + '.') + std::string(key.name); }
};

/// The keys of all scenes, in the order of the file. All walls have the same keys, listed once in
/// the table "walls.SIDE".
std::vector<KeyDoc> key_docs();

}  // namespace clatter
