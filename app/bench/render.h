#pragma once

#include <string>

namespace clatter {

/// Prints the CPU time of each viewport of a film per frame, by number of disks and picture size.
/// `count` is the number of disks; 0: all of the table. Writes the table also to `json`, unless it
/// is empty. Returns the exit code.
int bench_render(const std::string& json, int count);

}  // namespace clatter
