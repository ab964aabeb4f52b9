#pragma once

#include <vector>

#include "render/camera.h"

namespace clatter {

/// Finds disks on a picture that nearer disks hide completely. The picture is divided into square
/// blocks, and a block is covered once a single disk contains all of it. So no disk with a visible
/// pixel is taken for hidden, but some hidden ones are not found.
class Occlusion {
 public:
  /// An empty picture of `size`. Disks of this radius in pixels can cover blocks.
  Occlusion(Size size, double radius);

  /// Whether covered blocks hide the rectangle between two corners, in pixels. Parts outside of the
  /// picture count as the blocks at its edge.
  bool hides(const Vec2& low, const Vec2& high) const;
  /// Covers the blocks inside a disk, in pixels.
  void cover(const Vec2& centre, double radius);

 private:
  int block_;
  int columns_, rows_;
  std::vector<bool> covered_;  // [rows][columns]
};

}  // namespace clatter
