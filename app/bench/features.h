#pragma once

#include <string>

namespace clatter {

/// Prints the collision rate with each optional feature of a scene, relative to the rate of the
/// bare run: elastic disks in a periodic box. All runs alternate in one process. `count` is the
/// number of disks; 0: 1000. Writes the table also to `json`, unless it is empty. Returns the exit
/// code.
int bench_features(const std::string& json, int count);

}  // namespace clatter
