#pragma once

#include "app/view/stage.h"

namespace clatter {

/// The right and the upper wall, to be taken with the mouse and put elsewhere. The box keeps its
/// lower left corner, so that disks keep their places.
class WallGrip {
 public:
  /// A box of another size, once the wall is let go.
  std::optional<Vec2> use(const Stage& stage, const Frame& frame, ImVec2 corner, float scale,
                          bool over);
  /// Whether a wall is under the mouse, or is held.
  bool active() const { return axis_.has_value(); }
  /// Marks it, and where it would stand.
  void mark(ImDrawList& list, const Stage& stage, const Frame& frame, ImVec2 corner,
            float scale) const;

 private:
  std::optional<int> axis_;  // of the wall that is near, or held
  bool held_ = false;
  double length_ = 0.0;  // of the box along it
};

}  // namespace clatter
