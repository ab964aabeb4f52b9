#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// A key that two scenes give different values, or that one of them lacks.
struct KeyDifference {
  std::string key;     ///< dotted: "walls.left.kind"
  std::string before;  ///< the value as TOML; empty: the scene has no such key
  std::string now;     ///< likewise
};

/// All keys in which two scenes differ, given as scene files, sorted. Throws UserError where one is
/// no TOML; `file` names the one before.
std::vector<KeyDifference> differences(std::string_view before, std::string_view now,
                                       const std::string& file);

}  // namespace clatter
