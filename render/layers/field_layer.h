#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/gl_object.h"
#include "render/gl/shader_program.h"
#include "render/layers/face_layer.h"
#include "render/palette.h"
#include "render/plane_map.h"
#include "render/tiling.h"

namespace clatter {

/// The colours of a plane field as a texture for field.frag: in texture unit 0, multiplied by their
/// opacity, which is the share of cells with a value.
class FieldTexture {
 public:
  explicit FieldTexture(const Gl& gl);

  /// Binds the colours of a map in this style, and the blending for them. To be followed by
  /// unbind() after drawing.
  void bind(const PlaneMap& map, const ColourScale& scale, FieldStyle style);
  /// Restores the usual blending of layers.
  void unbind() const;

 private:
  const Gl* gl_;
  Texture cells_;
  std::vector<Colour> colours_;  ///< [height][width]; reused to avoid allocations
};

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

/// The slices of a view; without any, and without a volume, the middle one across z.
std::vector<Slice> slices_of(const Snapshot& snapshot, const View& view);

/// Draws slices through a field of spheres.
class SliceLayer {
 public:
  explicit SliceLayer(const Gl& gl);

  /// Draws slices of the field of the snapshot. A smooth slice is a mean over neighbouring layers
  /// of cells. `gap` is the colour of the hatching of cells without a value.
  void draw(const Snapshot& snapshot, const std::vector<Slice>& slices,
            const Projection& projection, const Eye& eye, const ColourScale& scale,
            FieldStyle style, Colour gap);

 private:
  const Gl* gl_;
  FaceLayer faces_;
  FieldTexture texture_;
};

}  // namespace clatter
