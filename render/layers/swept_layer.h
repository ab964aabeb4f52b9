#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/strokes.h"

namespace clatter {

/// Draws disks as a shutter sees them that is open for the snapshot's exposure: each pixel has the
/// light of every disk for the share of time in which it covers the pixel, which is exact for
/// straight flights. Particles never overlap, so that their shares add up.
class SweptLayer {
 public:
  explicit SweptLayer(const Gl& gl);

  /// Draws the disks along the snapshot's flights over what is bound, which must be of sRGB. A disk
  /// has the colour of the snapshot's time.
  void draw(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours);

 private:
  const Gl* gl_;
  Program program_;
  LightLayer light_;
  Strokes strokes_;
  std::vector<Stroke> drawn_;  ///< kept to save its memory
};

}  // namespace clatter
