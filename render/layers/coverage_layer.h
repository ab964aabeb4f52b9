#pragma once

#include "render/layers/coverage.h"
#include "render/program.h"

namespace clatter {

/// Draws disks that are too small to have a shape as the light that they send from each pixel.
class CoverageLayer {
 public:
  explicit CoverageLayer(const Gl& gl);

  /// Draws `coverage` over what is bound, in linear light; of what lies outside the corners of the
  /// box, in pixels, only a ghost.
  void draw(const Coverage& coverage, const Vec2& box_low, const Vec2& box_high) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< without attributes: the shader knows the corners
  Texture light_;
};

}  // namespace clatter
