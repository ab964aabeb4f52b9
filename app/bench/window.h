#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace clatter {

/// The scene of the tables about the window: the vibrated box over a heatmap of its temperature.
/// Its area grows with the number of disks.
Scene window_scene(int count);

/// Prints the CPU time of the window's thread per picture, with many disks over a heatmap and an
/// OpenGL without any effect, and that of a changed restitution beside that of the same simulation
/// built again. `count` is the number of disks; 0: 10,000. Writes the table also to `json`, unless
/// it is empty. Needs a display for GLFW. Returns the exit code.
int bench_window(const std::string& json, int count);

}  // namespace clatter
