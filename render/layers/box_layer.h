#pragma once

#include "engine/picture/snapshot.h"
#include "render/layers/face_layer.h"
#include "render/layers/line_layer.h"
#include "render/layers/wall_colours.h"

namespace clatter {

/// Draws the sides of a box of spheres: the far ones as walls with a pattern of their kind, and all
/// edges as lines, dashed between periodic borders.
class BoxLayer {
 public:
  /// Sides of the box: all, those behind the spheres, or those in front of them.
  enum class Sides { All, Far, Near };

  explicit BoxLayer(const Gl& gl);

  /// Draws the sides that face the viewer from behind the spheres.
  void draw_sides(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                  const WallColours& colours) const;
  /// Draws the edges of sides where no sphere hides them.
  void draw_edges(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                  const WallColours& colours, Sides sides = Sides::All);

 private:
  const Gl* gl_;
  FaceLayer faces_;
  LineLayer lines_;
};

}  // namespace clatter
