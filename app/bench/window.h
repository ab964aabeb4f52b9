#pragma once

#include <string>

namespace clatter {

/// Prints the CPU time of the window's thread per picture, with many disks over a heatmap and an
/// OpenGL without any effect. `count` is the number of disks; 0: 10,000. Writes the table also to
/// `json`, unless it is empty. Needs a display for GLFW. Returns the exit code.
int bench_window(const std::string& json, int count);

}  // namespace clatter
