#pragma once

#include <string>

namespace clatter {

/// Prints the CPU time of jumps to random times of a run, and the memory of its recorded states.
/// The run has as many time units as 10 minutes in the window at the speed of the scene. `count` is
/// the number of disks; 0: 1000 and 20,000. Writes the table also to `json`, unless it is empty.
/// Returns the exit code.
int bench_timeline(const std::string& json, int count);

}  // namespace clatter
