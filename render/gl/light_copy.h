#pragma once

#include "render/gl/canvas.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// OpenGL ES: copies a canvas between its stored sRGB values and its picture for blending in linear
/// light, see Canvas. Each copy has the bits of the other.
class LightCopy {
 public:
  explicit LightCopy(const Gl& gl);

  /// Makes later draw calls blend in linear light or in stored values. The canvas must be bound.
  void blend_in_light(Canvas& canvas, bool on) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
};

}  // namespace clatter
