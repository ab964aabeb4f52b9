#pragma once

#include <vector>

#include "render/eye.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// Draws straight lines in space with a constant width on the picture. Spheres hide them.
class LineLayer {
 public:
  explicit LineLayer(const Gl& gl);

  /// Removes all lines. Later ones are for this eye and scale of depths.
  void restart(const Eye& eye, double depth_range);
  /// Adds a line between two world positions. `width` is in drawn pixels.
  void add(const Vec3& from, const Vec3& to, double width, Colour colour);
  /// Draws the lines. `dash` is the period of dashes in drawn pixels; 0: no dashes.
  void draw(Size drawn, double dash = 0.0) const;

 private:
  struct Vertex {
    float x, y, depth;          // drawn pixels, and 0..1
    float across, along, half;  // drawn pixels
    Colour colour;
  };

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
  std::vector<Vertex> corners_;  ///< six of each line, two triangles
  const Eye* eye_ = nullptr;
  double depth_range_ = 1.0;
};

}  // namespace clatter
