#pragma once

#include <string>
#include <vector>

#include "app/view/fading_ink.h"
#include "app/view/stopwatch.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The sliders of lecture mode for a scene that names none: the restitution of inelastic particles,
/// then the drive, gravity and the number of particles, as far as the scene has them.
std::vector<std::string> usual_sliders(const Scene& scene);

/// The tools of lecture mode.
struct LectureTools {
  bool pen = false;       ///< the mouse draws lines that fade out
  bool pointer = false;   ///< the pointer has a ring and a trail
  bool timeline = false;  ///< the timeline is shown
  bool captions = true;   ///< the caption of the scene is shown
  bool settings = false;  ///< the settings of lecture mode are shown
  bool plot = true;       ///< the large plot is shown
  Theme theme = Theme::Projector;
  FadingInk lines{8.0, 2.0};  ///< of the pen
  FadingInk trail{0.7, 0.7};  ///< of the pointer
  Stopwatch stopwatch;
  std::uint64_t run = 0;  ///< the run that the stopwatch measures

  /// Whether the picture changes without input.
  bool changes() const { return lines.visible() || trail.visible() || stopwatch.runs(); }
};

}  // namespace clatter
