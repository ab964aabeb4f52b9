#pragma once

#include <string>

namespace clatter {

/// Prints the CPU time that each viewport of a film takes a frame, for numbers of disks and sizes
/// of pictures; to a JSON file, too, unless `json` is empty. `count` is one number of disks, 0 all
/// of the table. Returns the exit code.
int bench_render(const std::string& json, int count);

}  // namespace clatter
