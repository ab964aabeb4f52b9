#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"

namespace clatter {

/// Draws a field as a heatmap over the box. Cells without a value are hatched.
class FieldLayer {
 public:
  explicit FieldLayer(const Gl& gl);

  /// Draws `map` over the box from the origin to `box`. `gap` is the colour of the hatching.
  void draw(const FieldMap& map, const Vec2& box, const Projection& projection,
            const ColourScale& scale, Colour gap);

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
  Texture cells_;
  std::vector<Colour> colours_;  ///< [cells_y][cells_x]; reused to avoid allocations
};

}  // namespace clatter
