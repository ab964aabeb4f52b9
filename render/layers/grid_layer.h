#pragma once

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"

namespace clatter {

/// The side of the grid's squares and the length of the scale bar in a picture: a round number of
/// disk diameters.
double scale_length(const Snapshot& snapshot, const Projection& projection);

/// Draws a grid over the box, from its lower left corner on.
class GridLayer {
 public:
  explicit GridLayer(const Gl& gl);

  /// Draws lines of this colour.
  void draw(const Snapshot& snapshot, const Projection& projection, Colour colour) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< without attributes: the shader knows the corners
};

}  // namespace clatter
