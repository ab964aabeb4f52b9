#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/gl/gl_object.h"
#include "render/layers/disk_colours.h"

namespace clatter {

/// What is drawn about a straight way: three pairs of numbers, which a vertex shader reads as
/// attributes 0 to 2 and places a rectangle by, and its light, attribute 3.
struct Stroke {
  std::array<Eigen::Vector2f, 3> pairs;
  Light light;
};

/// Draws strokes, as instances of one rectangle.
class Strokes {
 public:
  explicit Strokes(const Gl& gl);

  /// Draws them by the program in use.
  void draw(const std::vector<Stroke>& strokes);

 private:
  const Gl* gl_;
  Buffer buffer_;
  VertexArray vertices_;
};

}  // namespace clatter
