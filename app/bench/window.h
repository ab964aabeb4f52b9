#pragma once

#include <string>

namespace clatter {

/// Prints the CPU time that the window's thread takes a picture of many disks over a heatmap, with
/// an OpenGL that does nothing; to a JSON file, too, unless `json` is empty. `count` is the number
/// of disks, 0: 10,000. It needs a display for GLFW. Returns the exit code.
int bench_window(const std::string& json, int count);

}  // namespace clatter
