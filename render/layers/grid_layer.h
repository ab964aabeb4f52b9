#pragma once

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"

namespace clatter {

/// Spacing of the grid and length of the scale bar, a round number of units a.
double scale_length(const Projection& projection);

/// Draws a square grid over the box, with its origin at the lower left corner.
class GridLayer {
 public:
  explicit GridLayer(const Gl& gl);

  /// Draws grid lines of this colour.
  void draw(const Snapshot& snapshot, const Projection& projection, Colour colour) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
};

}  // namespace clatter
