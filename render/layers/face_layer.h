#pragma once

#include <array>
#include <vector>

#include "engine/publish/snapshot.h"
#include "render/eye.h"
#include "render/gl/shader_program.h"
#include "render/layers/line_layer.h"
#include "render/palette.h"
#include "render/theme.h"

namespace clatter {

/// A rectangle in space across an axis.
struct Rectangle3 {
  int axis = 2;           ///< it is across this axis
  double position = 0.0;  ///< on this axis
  Vec2 low, high;         ///< corners, on the other two axes in order
};

/// Draws rectangles in space with a fragment shader of their own.
class FaceLayer {
 public:
  /// `fragment_file` is the fragment shader for face.vert.
  FaceLayer(const Gl& gl, const char* fragment_file);

  /// Makes the program current, and sets the uniforms of the view.
  const Program& use(const Projection& projection, const Eye& eye, double depth_range) const;
  /// Draws a rectangle. Positions in it run from the origin to `place`.
  void draw(const Rectangle3& rectangle, const Eye& eye, const Vec2& place) const;

 private:
  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
};

/// Draws the sides of a box of spheres: the far ones as walls with a pattern of their kind, and all
/// edges as lines, dashed between periodic borders.
class BoxLayer {
 public:
  explicit BoxLayer(const Gl& gl);

  /// Draws the sides that face the viewer from behind the spheres.
  void draw_sides(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                  const ThemeColours& theme) const;
  /// Draws the edges that no sphere hides.
  void draw_edges(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                  const ThemeColours& theme);

 private:
  const Gl* gl_;
  FaceLayer faces_;
  LineLayer lines_;
};

/// Draws slices through a field of spheres.
class SliceLayer {
 public:
  explicit SliceLayer(const Gl& gl);

  /// Draws the slices of a view, or the middle one across z.
  void draw(const Snapshot& snapshot, const std::vector<Slice>& slices,
            const Projection& projection, const Eye& eye, const ColourScale& scale, Colour gap);

 private:
  const Gl* gl_;
  FaceLayer faces_;
  Texture cells_;
  std::vector<Colour> colours_;  ///< of the cells of a slice; reused to avoid allocations
};

}  // namespace clatter
