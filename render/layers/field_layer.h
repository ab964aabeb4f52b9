#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"

namespace clatter {

/// Draws a field as a heatmap over the box; cells without a value are hatched.
class FieldLayer {
 public:
  explicit FieldLayer(const Gl& gl);

  /// Draws `map` over a box from the origin to `box`; `gap` is the colour of hatches.
  void draw(const FieldMap& map, const Vec2& box, const Projection& projection,
            const ColourScale& scale, Colour gap);

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< without attributes: the shader knows the corners
  Texture cells_;
  std::vector<Colour> colours_;  ///< [cells_y][cells_x]; kept to save its memory
};

}  // namespace clatter
