#pragma once

#include <span>
#include <vector>

#include "render/eye.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// A straight line in space.
struct Line {
  Vec3 from, to;       ///< world positions
  double width = 1.0;  ///< on the picture, drawn pixels
  Colour colour;
};

/// Draws straight lines in space with a constant width on the picture. Spheres hide them where the
/// depth test is enabled.
class LineLayer {
 public:
  explicit LineLayer(const Gl& gl);

  /// Draws lines in a box of spheres. `dash` is the period of dashes in drawn pixels; 0: none.
  void draw(std::span<const Line> lines, const Vec3& box, const Projection& projection,
            const Eye& eye, double dash = 0.0);

 private:
  struct Vertex {
    float x, y, depth;          // drawn pixels, and 0..1
    float across, along, half;  // drawn pixels
    Colour colour;
  };

  void add(const Line& line, const Eye& eye, double depth_range);

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
  std::vector<Vertex> corners_;  ///< six of each line, two triangles; reused to avoid allocations
};

}  // namespace clatter
