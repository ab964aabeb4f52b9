#pragma once

#include "app/view/messages.h"
#include "app/view/viewport.h"

namespace clatter {

/// Resizes the box by dragging its walls with the mouse. A wall moves by as much as the mouse, and
/// a click changes nothing. Arguments `corner` and `scale` are as in Viewport.
class WallGrip {
 public:
  /// A new box for the gas.
  struct Resized {
    Vec2 box;    ///< new size
    Vec2 shift;  ///< shift of the disks, which keeps them at their places on the viewport
  };

  /// Handles the mouse. Returns the new box when a moved wall is released. `over`: the mouse is
  /// over the viewport.
  std::optional<Resized> use(const Viewport& viewport, const Frame& frame, ImVec2 corner,
                             float scale, bool over);
  /// True if a wall is under the mouse or being dragged.
  bool active() const { return side_.has_value(); }
  /// Marks that wall, at its new position while it is dragged.
  void mark(ImDrawList& list, const Viewport& viewport, const Frame& frame, ImVec2 corner,
            float scale) const;

  /// Area where the wall of a side can be grabbed, in window units. It is just outside the box,
  /// where there are no disks to pick.
  static Area handle(const Viewport& viewport, const Frame& frame, ImVec2 corner, float scale,
                     Side side);

 private:
  std::optional<Side> side_;  // wall under the mouse or being dragged
  bool held_ = false;
  bool moved_ = false;   // the held wall follows the mouse
  ImVec2 pressed_;       // position of the mouse at the press
  double length_ = 0.0;  // length of the box perpendicular to that wall
};

}  // namespace clatter
