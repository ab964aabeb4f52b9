#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/layers/face_layer.h"
#include "render/layers/field_layer.h"

namespace clatter {

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
