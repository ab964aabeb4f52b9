#pragma once

#include "engine/picture/snapshot.h"
#include "render/layers/face_layer.h"
#include "render/layers/line_layer.h"
#include "render/layers/wall_colours.h"

namespace clatter {

/// The pattern of a surface in space. Must match side.frag and sphere.frag.
enum class SidePattern { Hatch, Rings, Waves, Glow };

/// The pattern of a kind of wall.
SidePattern side_pattern(WallKind kind);

/// Displacement of the rings of a driven wall, in periods, below 1. They move as fast as the
/// equivalent moving wall.
double ring_advance(const Wall& wall, double time, double period);

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
