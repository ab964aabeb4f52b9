#pragma once

#include <array>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/wall_colours.h"

namespace clatter {

/// Thickness of the band outside the box that shows a wall, in pixels of a picture of `size`.
double wall_thickness(Size size);

/// Lower left and upper right corner of the area between the walls' faces or periodic borders, in
/// world units.
struct Faces {
  Vec2 low, high;
};

/// The faces at the time of the snapshot.
Faces faces_of(const Snapshot& snapshot);

/// The faces at their outermost positions.
Faces outermost_faces(const Snapshot& snapshot);

/// Draws the sides of the box. The teeth of a driven wall move into the box at half its drive
/// speed, the speed of the equivalent moving wall. A saw-tooth or sinusoidal wall moves over a line
/// at the side of the box. A thermal wall glows, a static wall is hatched, a periodic border is
/// dashed.
class WallLayer {
 public:
  /// A vertex of a band, with the layout of the shader attributes.
  struct Vertex {
    float x, y;            // drawn pixels
    float along, outward;  // pixels from the lower or left end of the box, and from the face
  };

  explicit WallLayer(const Gl& gl);

  /// Draws the four sides of the snapshot's box.
  void draw(const Snapshot& snapshot, const Projection& projection,
            const WallColours& colours) const;

 private:
  void draw_place(Side side, const Snapshot& snapshot, const Projection& projection,
                  const WallColours& colours) const;
  void draw_side(Side side, const Snapshot& snapshot, const Projection& projection,
                 const WallColours& colours) const;
  void draw_band(const std::array<Vertex, 4>& corners, int pattern, Colour colour) const;

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
};

}  // namespace clatter
