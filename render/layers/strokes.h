#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/gl/gl_object.h"
#include "render/gl/instance_numbers.h"
#include "render/layers/disk_colours.h"

namespace clatter {

/// A rectangle around a line segment. A vertex shader reads `pairs` as attributes 0 to 2, with the
/// position of the rectangle, and `light` as attribute 3.
struct Stroke {
  std::array<Eigen::Vector2f, 3> pairs;
  Light light;
};

/// Draws strokes, as instances of one rectangle.
class Strokes {
 public:
  explicit Strokes(const Gl& gl);

  /// Draws strokes with the program in use. The vertex shader reads the widths, in pixels, as
  /// attribute 4. They are one of each stroke, or one for all.
  void draw(const std::vector<Stroke>& strokes, const std::vector<float>& widths);

 private:
  const Gl* gl_;
  Buffer buffer_;
  InstanceNumbers widths_;
  VertexArray vertices_;
};

}  // namespace clatter
