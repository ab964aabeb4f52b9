#pragma once

#include "engine/stop_request.h"
#include "render/gl/canvas.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// Draws a supersampled picture at the final resolution, with a box filter in linear light.
class AverageLayer {
 public:
  explicit AverageLayer(const Gl& gl);

  /// Replaces the bound picture by `fine`, which has `samples` pixels per final pixel along each
  /// axis. The colours of a `transparent` picture are premultiplied by alpha. Throws Interrupted if
  /// a stop request is made during the drawing of a large picture.
  void draw(const Canvas& fine, int samples, bool transparent = false,
            const StopRequest& stop = {}) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
};

}  // namespace clatter
