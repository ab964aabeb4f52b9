#pragma once

#include "render/gl/canvas.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// Draws a finer picture, averaged over the samples of each pixel in linear light (a box filter).
class AverageLayer {
 public:
  explicit AverageLayer(const Gl& gl);

  /// Replaces the picture that is bound by `fine`, which has `samples` along each axis of a pixel,
  /// and of a `transparent` picture colours that are times their opacity.
  void draw(const Canvas& fine, int samples, bool transparent = false) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< without attributes: the shader knows the corners
};

}  // namespace clatter
