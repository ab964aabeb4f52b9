#pragma once

#include "render/canvas.h"
#include "render/program.h"

namespace clatter {

/// Draws a finer picture, averaged over the samples of each pixel in linear light (a box filter).
class AverageLayer {
 public:
  explicit AverageLayer(const Gl& gl);

  /// Replaces the picture that is bound by `fine`, which has `samples` along each axis of a pixel.
  void draw(const Canvas& fine, int samples) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< without attributes: the shader knows the corners
};

}  // namespace clatter
