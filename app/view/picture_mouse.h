#pragma once

#include "app/view/piston_hand.h"
#include "app/view/session.h"
#include "app/view/wall_grip.h"
#include "app/view/window_map.h"
#include "app/view/window_parts.h"

namespace clatter {

class LectureMode;

/// The mouse on the picture: walls, the piston, tools, the pen of a lecture, camera and particles.
class PictureMouse {
 public:
  PictureMouse(const WindowParts& parts, LectureMode& lecture);

  /// Handles the mouse on the viewport, which has a picture, and draws marks there. `corner` and
  /// `scale` are as in Viewport::map().
  void use(ImVec2 corner, float scale);

 private:
  void use_cells(ImVec2 corner, float scale);
  void log_handles(const WindowMap& map) const;

  ScriptLog& log_;
  Session& session_;
  Controls& controls_;
  Viewport& viewport_;
  MouseTools& mouse_tools_;
  LectureMode& lecture_;
  WallGrip wall_grip_;
  PistonHand piston_hand_;
};

}  // namespace clatter
