#pragma once

#include <array>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"
#include "render/theme.h"

namespace clatter {

/// How thick the band outside the box is that shows a wall, in pixels of a picture of `size`.
double wall_thickness(Size size);

/// Opposite corners of a box between faces of walls, or periodic borders; world units.
struct Faces {
  Vec2 low, high;
};

/// Where the faces are at the snapshot's time.
Faces faces_of(const Snapshot& snapshot);

/// Where they are farthest out.
Faces outermost_faces(const Snapshot& snapshot);

/// Draws the sides of the box so that they look like what they do: a driven wall's teeth move into
/// the box at the speed it stands for, a saw-tooth or sinusoidal one moves as a whole over a line
/// that marks its place, a thermal one glows, a static one is hatched, and a periodic border is a
/// dashed line.
class WallLayer {
 public:
  /// A corner of a band, as the shader gets it.
  struct Vertex {
    float x, y;            // pixels
    float along, outward;  // pixels from the box's lower or left end, and from the wall's face
  };

  explicit WallLayer(const Gl& gl);

  /// Draws the four sides of the snapshot's box.
  void draw(const Snapshot& snapshot, const Projection& projection,
            const ThemeColours& theme) const;

 private:
  void draw_place(Side side, const Snapshot& snapshot, const Projection& projection,
                  const ThemeColours& theme) const;
  void draw_side(Side side, const Snapshot& snapshot, const Projection& projection,
                 const ThemeColours& theme) const;
  void draw_band(const std::array<Vertex, 4>& corners, int pattern, Colour colour) const;

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
};

}  // namespace clatter
