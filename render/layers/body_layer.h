#pragma once

#include <vector>

#include "render/bodies.h"
#include "render/layers/box_layer.h"
#include "render/layers/light_layer.h"

namespace clatter {

/// Draws the fixtures of spheres. Obstacles are lit bodies with depths: balls, and boxes with
/// edges. Partitions are translucent plates with lines around them and their holes, dashed for
/// membranes, and dashed lines across valves. The patterns of the sides of the box show the laws.
///
/// Bodies come before the spheres, so that depths hide spheres behind them. The soft edges of balls
/// blend with these spheres, so they come after them.
class BodyLayer {
 public:
  /// Encoded blending is for pictures without a background.
  BodyLayer(const Gl& gl, Blending blending);

  /// Draws the faces of boxes. Edges come later.
  void draw_blocks(const Bodies& bodies, const Snapshot& snapshot, const Projection& projection,
                   const Eye& eye, const WallColours& colours) const;
  /// Parts of balls on the picture: pixels that a ball covers, or those that it covers in part.
  enum class Part { Inside, Edge };
  /// Draws parts of balls, by blending in linear light.
  void draw_balls(const Bodies& bodies, const Snapshot& snapshot, const Projection& projection,
                  const Eye& eye, const WallColours& colours, Part part) const;
  /// Draws the edges of boxes where no sphere hides them.
  void draw_edges(const Bodies& bodies, const Snapshot& snapshot, const Projection& projection,
                  const Eye& eye, const WallColours& colours);
  /// Draws the partitions where no sphere hides them.
  void draw_partitions(const Bodies& bodies, const Snapshot& snapshot, const Projection& projection,
                       const Eye& eye, const WallColours& colours);

 private:
  struct Look {
    Colour fill, colour;
  };

  Look look_of(const FixtureLaw& law, const WallColours& colours) const;
  void set_law(const Program& program, const FixtureLaw& law, const Snapshot& snapshot,
               double period) const;
  void draw_plate(const Partition& partition, const Bodies& bodies, const Snapshot& snapshot,
                  const Projection& projection, const Eye& eye, const WallColours& colours) const;
  void draw_rims(const Partition& partition, const Bodies& bodies, const Snapshot& snapshot,
                 const Projection& projection, const Eye& eye, const WallColours& colours);

  const Gl* gl_;
  Blending blending_;
  FaceLayer faces_;
  LineLayer lines_;
  Program balls_;
  Buffer buffer_;
  VertexArray vertices_;
};

}  // namespace clatter
