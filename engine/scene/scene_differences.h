#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// A key with different values in two scenes, or absent in one of them.
struct KeyDifference {
  std::string key;     ///< dotted: "walls.left.kind"
  std::string before;  ///< the value as TOML; empty: the scene has no such key
  std::string now;     ///< the value in the second scene; empty: no such key
};

/// All keys in which two scenes, given as texts of scene files, differ; sorted. Throws UserError if
/// a text is not TOML; `file` is the name of the first scene.
std::vector<KeyDifference> differences(std::string_view before, std::string_view now,
                                       const std::string& file);

}  // namespace clatter
