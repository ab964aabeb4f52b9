#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace clatter {

/// How the window opens.
struct WindowOptions {
  Scene scene;
  std::uint64_t seed = 1;
  int width = 1280;
  int height = 800;
  std::string script_log;  ///< file that is told what happens; empty: none
};

/// Shows a scene in a window until it is closed. Throws RunError where there is no display, or none
/// that can draw it.
void show_window(const WindowOptions& options);

}  // namespace clatter
