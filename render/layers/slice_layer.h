#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/layers/face_layer.h"
#include "render/palette.h"

namespace clatter {

/// The slices of a view; without any, and without a volume, the middle one across z.
std::vector<Slice> slices_of(const Snapshot& snapshot, const View& view);

/// Draws slices through a field of spheres.
class SliceLayer {
 public:
  explicit SliceLayer(const Gl& gl);

  /// Draws slices of the field of the snapshot.
  void draw(const Snapshot& snapshot, const std::vector<Slice>& slices,
            const Projection& projection, const Eye& eye, const ColourScale& scale, Colour gap);

 private:
  const Gl* gl_;
  FaceLayer faces_;
  Texture cells_;
  std::vector<Colour> colours_;  ///< of the cells of a slice; reused to avoid allocations
};

}  // namespace clatter
