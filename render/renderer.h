#pragma once

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/colour_range.h"
#include "render/layers/disk_layer.h"
#include "render/layers/field_layer.h"
#include "render/layers/overlay.h"
#include "render/layers/wall_layer.h"

namespace clatter {

/// Draws snapshots into the framebuffer that is bound. Automatic colour ranges follow the snapshots
/// it is given, so a film has a Renderer of its own.
class Renderer {
 public:
  /// Compiles the shaders; throws RunError. `gl` must outlive the renderer.
  explicit Renderer(const Gl& gl);

  /// The camera that shows the whole box, clear of what the overlay writes.
  Camera fit(const Snapshot& snapshot, Size size, const View& view, const OverlayText& text);

  /// Draws a picture of `size`.
  void draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
            const OverlayText& text);

 private:
  struct Scales {
    ColourScale disks, field;
  };
  Scales scales_for(const Snapshot& snapshot, const View& view);
  static std::vector<Legend> legends(const Snapshot& snapshot, const View& view,
                                     const Scales& scales);

  const Gl* gl_;
  FieldLayer field_;
  WallLayer walls_;
  DiskLayer disks_;
  Overlay overlay_;
  SteadyExtent disk_extent_;
  SteadyExtent field_extent_;
};

}  // namespace clatter
