#pragma once

#include <string>

namespace clatter {

/// Prints how fast collisions are with each thing that a scene may add, as shares of the bare run's
/// rate: elastic disks in a periodic box. All run interleaved in one process. `count` disks; 0:
/// 1000. Writes the table to `json` too, unless that is empty; returns the exit code.
int bench_features(const std::string& json, int count);

}  // namespace clatter
