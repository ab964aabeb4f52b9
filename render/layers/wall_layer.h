#pragma once

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/palette.h"
#include "render/program.h"

namespace clatter {

/// How thick the band outside the box is that shows a wall, in pixels of a picture of `size`.
double wall_thickness(Size size);

/// Draws the sides of the box so that they look like what they do: a driven wall's teeth move into
/// the box at the speed it stands for, a thermal one glows, a static one is hatched, and a periodic
/// border is a dashed line.
class WallLayer {
 public:
  explicit WallLayer(const Gl& gl);

  /// Draws the four sides of the snapshot's box.
  void draw(const Snapshot& snapshot, const Projection& projection) const;

 private:
  void draw_side(Side side, const Snapshot& snapshot, const Projection& projection) const;

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
};

}  // namespace clatter
