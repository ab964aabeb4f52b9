#pragma once

#include "app/view/messages.h"
#include "app/view/viewport.h"

namespace clatter {

/// The walls of the box, to be taken with the mouse and put elsewhere.
class WallGrip {
 public:
  /// Another box for the gas.
  struct Resized {
    Vec2 box;
    Vec2 shift;  ///< of the disks in it, which stay where they are on the viewport
  };

  /// The box that there is to be, once a wall is let go elsewhere.
  std::optional<Resized> use(const Viewport& viewport, const Frame& frame, ImVec2 corner,
                             float scale, bool over);
  /// Whether a wall is under the mouse, or is held.
  bool active() const { return side_.has_value(); }
  /// Marks it, and where it would stand.
  void mark(ImDrawList& list, const Viewport& viewport, const Frame& frame, ImVec2 corner,
            float scale) const;

  /// Where the wall of a side can be taken: just outside it, where there are no disks to be picked.
  static Area handle(const Viewport& viewport, const Frame& frame, ImVec2 corner, float scale,
                     Side side);

 private:
  std::optional<Side> side_;  // of the wall that is near, or held
  bool held_ = false;
  double length_ = 0.0;  // of the box across it
};

}  // namespace clatter
