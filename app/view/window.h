#pragma once

#include <optional>
#include <string>

#include "engine/scene/scene.h"
#include "render/camera.h"

namespace clatter {

/// How the window opens.
struct WindowOptions {
  Scene scene;
  std::uint64_t seed = 1;
  Size size = {1280, 800};
  std::optional<double> until;  ///< simulation time at which the gas halts; absent: none
  std::string script_log;       ///< file that is told what happens; empty: none
};

/// Shows a scene in a window until it is closed. Throws RunError, which names `clatter render`,
/// where there is no display, none that can draw it, or where its OpenGL is lost.
void show_window(const WindowOptions& options);

}  // namespace clatter
