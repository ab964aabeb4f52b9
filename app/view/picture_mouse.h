#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/view/session.h"
#include "app/view/wall_grip.h"
#include "app/view/window_map.h"
#include "app/view/window_parts.h"

namespace clatter {

/// Moves the piston, the right wall, after the mouse. While the gas plays, the run records strokes
/// of a tenth of a second of playing, each at most as fast as the thermal speed. A drag is one undo
/// entry.
class PistonHand {
 public:
  /// Handles a frame. `wanted` is the position of the mouse on the x axis; absent: no drag.
  void use(Session& session, std::optional<double> wanted);

 private:
  struct Drag {
    std::uint64_t run;         // of the frame
    std::vector<Change> acts;  // strokes so far
  };

  void push(Session& session, double wanted);
  void release(Session& session);

  std::optional<Drag> drag_;
};

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
