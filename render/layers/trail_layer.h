#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/strokes.h"

namespace clatter {

/// Draws the way that disks have come as lines in their colours, which fade out.
class TrailLayer {
 public:
  explicit TrailLayer(const Gl& gl);

  /// Draws the snapshot's flights of the last `time` > 0 over what is bound, which must be of sRGB.
  void draw(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours,
            double time);

 private:
  const Gl* gl_;
  Program program_;
  LightLayer light_;
  Strokes strokes_;
  std::vector<Stroke> drawn_;  ///< kept to save its memory
};

}  // namespace clatter
