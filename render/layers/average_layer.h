#pragma once

#include "engine/stop_request.h"
#include "render/gl/canvas.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// Draws a supersampled picture at the final resolution, with a box filter in linear light. Also
/// averages several such pictures.
class AverageLayer {
 public:
  explicit AverageLayer(const Gl& gl);

  /// Replaces the bound picture by `fine`, which has `samples` pixels per final pixel along each
  /// axis. The colours of a `transparent` picture are premultiplied by alpha. Throws Interrupted if
  /// a stop request is made during the drawing of a large picture.
  void draw(const Canvas& fine, int samples, bool transparent = false,
            const StopRequest& stop = {}) const;
  /// Adds the light of `fine` times `weight` to the bound picture of floating-point numbers. They
  /// are light times opacity, and opacity.
  void add(const Canvas& fine, int samples, bool transparent, double weight,
           const StopRequest& stop = {}) const;
  /// Replaces the bound picture by a sum of add().
  void draw_sum(const Canvas& sum, bool transparent, const StopRequest& stop = {}) const;

 private:
  struct Pass {
    int samples;
    bool transparent;
    bool light_in, light_out;
    double weight;
  };
  void draw_pass(const Canvas& picture, const Pass& pass, const StopRequest& stop) const;

  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
};

}  // namespace clatter
