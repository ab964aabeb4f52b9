#pragma once

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/field_texture.h"
#include "render/tiling.h"

namespace clatter {

/// The field of a snapshot of disks.
PlaneMap plane_of(const Snapshot& snapshot);

/// The style of a heatmap. A residual belongs to its own cell, so it is not smoothed.
FieldStyle style_of(Field field, const View& view);

/// True if a heatmap has a value in some cell. False before the first average.
bool has_values(const FieldMap& map);

/// Draws a field as a heatmap over the box. In the style of cells those without a value are
/// hatched.
class FieldLayer {
 public:
  explicit FieldLayer(const Gl& gl);

  /// Draws the field of the snapshot over its box, and faintly over the copies of the box. `gap` is
  /// the colour of the hatching.
  void draw(const Snapshot& snapshot, const Projection& projection, const ColourScale& scale,
            FieldStyle style, Colour gap, const Tiling& tiling = {});

 private:
  const Gl* gl_;
  Program smooth_, hatched_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
  FieldTexture texture_;
};

}  // namespace clatter
