#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/chords.h"
#include "render/tiling.h"

namespace clatter {

/// Draws the past paths of the disks as lines in the colours of the disks, which fade out with age.
/// The width of a line is a fifth of the diameter of its disk.
class TrailLayer {
 public:
  explicit TrailLayer(const Gl& gl);

  /// Draws the parts of flights in the last `time` > 0, also in the copies of the box, into the
  /// bound framebuffer, which must be sRGB.
  void draw(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
            const Projection& projection, const DiskColours& colours, double time,
            const Tiling& tiling = {});

 private:
  const Gl* gl_;
  Program program_;
  LightLayer light_;
  Strokes strokes_;
  std::vector<Stroke> drawn_;  ///< reused to avoid allocations
  std::vector<float> halves_;  ///< half the widths; of disks that are alike one for all
};

}  // namespace clatter
