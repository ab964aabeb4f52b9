#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/chords.h"
#include "render/tiling.h"

namespace clatter {

/// Draws disks with motion blur over the exposure time of the snapshot. A pixel receives the light
/// of each disk times the fraction of time that the disk covers it, exact for straight flights.
/// Disks never overlap, so these fractions add up to at most 1.
class SweptLayer {
 public:
  explicit SweptLayer(const Gl& gl);

  /// Draws the disks along the flights of the snapshot, also in the copies of the box, into the
  /// bound framebuffer, which must be sRGB. A disk has its colour at the time of the snapshot.
  /// Disks with a radius below `least` pixels are left out.
  void draw(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours,
            const Tiling& tiling, double least = 0.0);

 private:
  const Gl* gl_;
  Program program_;
  LightLayer light_;
  Strokes strokes_;
  std::vector<Stroke> drawn_;  ///< reused to avoid allocations
  std::vector<float> radii_;   ///< of these, drawn pixels; of disks that are alike one for all
};

}  // namespace clatter
