#pragma once

#include <array>

#include "render/eye.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// A rectangle in space across an axis.
struct Rectangle3 {
  int axis = 2;           ///< it is across this axis
  double position = 0.0;  ///< on this axis
  Vec2 low, high;         ///< corners, on the other two axes in order
};

/// The other two axes of space, in order.
std::array<int, 2> others_of(int axis);

/// World position of a place on the plane of a rectangle.
Vec3 place_in(const Rectangle3& rectangle, const Vec2& place);

/// Draws rectangles in space with a fragment shader of their own.
class FaceLayer {
 public:
  /// `fragment_file` is the fragment shader for face.vert, with `defines` as for Program.
  FaceLayer(const Gl& gl, const char* fragment_file, const char* defines = "");

  /// Makes the program current, and sets the uniforms of the view of a box.
  const Program& use(const Vec3& box, const Projection& projection, const Eye& eye) const;
  /// Draws a rectangle. Positions in it run from `start` to `place`.
  void draw(const Rectangle3& rectangle, const Eye& eye, const Vec2& place,
            const Vec2& start = Vec2::Zero()) const;

 private:
  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
};

}  // namespace clatter
