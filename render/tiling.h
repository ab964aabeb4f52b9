#pragma once

#include <array>

#include "engine/picture/snapshot.h"
#include "render/camera.h"

namespace clatter {

/// The box of disks and its periodic copies on a picture.
struct Tiling {
  /// First and last copy along each axis, in box lengths from the box, which is 0.
  std::array<int, 2> first = {0, 0}, last = {0, 0};
  float faintness = 0.15f;  ///< opacity beyond the edges of the box, as a share

  /// Lower left and upper right corner of all copies together, in world units.
  Vec2 low(const Vec2& box) const { return {first[0] * box.x(), first[1] * box.y()}; }
  Vec2 high(const Vec2& box) const { return {(last[0] + 1) * box.x(), (last[1] + 1) * box.y()}; }
};

/// The copies of View::tiling that a picture shows; without it the box alone.
Tiling tiling_of(const Snapshot& snapshot, const Projection& projection, const View& view);

}  // namespace clatter
