#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/view/playlist.h"
#include "engine/scene/scene.h"
#include "render/camera.h"

namespace clatter {

/// Options of the window.
struct WindowOptions {
  Scene scene;
  std::vector<Scene> others;  ///< scenes in step with it, with the same seed
  std::uint64_t seed = 1;
  Size size = {1280, 800};             ///< size in screen units
  std::optional<double> until;         ///< simulation time at which the gas pauses; absent: none
  std::vector<PlaylistItem> playlist;  ///< empty: none; its first scene is `scene`
  bool sound = false;                  ///< whether collisions are heard from the start
  std::string script_log;              ///< file for the log of events, see ScriptLog; empty: none
};

/// Shows a scene in a window until the window is closed. Throws RunError if there is no display, no
/// OpenGL 3.3, or if the OpenGL context is lost. The error names `clatter render`.
void show_window(const WindowOptions& options);

}  // namespace clatter
