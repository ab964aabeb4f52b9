#pragma once

#include <optional>

#include "engine/picture/snapshot.h"
#include "engine/stop_request.h"
#include "render/camera.h"
#include "render/gl/canvas.h"
#include "render/layers/arrow_layer.h"
#include "render/layers/auto_ranges.h"
#include "render/layers/average_layer.h"
#include "render/layers/body_layer.h"
#include "render/layers/box_layer.h"
#include "render/layers/disk_layer.h"
#include "render/layers/field_layer.h"
#include "render/layers/fixture_layer.h"
#include "render/layers/grid_layer.h"
#include "render/layers/overlay.h"
#include "render/layers/sphere_layer.h"
#include "render/layers/sphere_light.h"
#include "render/layers/trail_layer.h"
#include "render/layers/volume_layer.h"
#include "render/layers/wall_layer.h"

namespace clatter {

/// Draws snapshots into the bound framebuffer.
class Renderer {
 public:
  /// Compiles the shaders. Throws RunError if that fails. `gl` must outlive the renderer. All
  /// layers except the overlay are drawn with `samples` pixels per final pixel along each axis, and
  /// averaged in linear light. With `transparent` the background is transparent, and colours are
  /// premultiplied by alpha. A `stop` request ends the drawing of a large picture.
  explicit Renderer(const Gl& gl, int samples = 1, bool transparent = false, StopRequest stop = {});

  /// The camera that shows the whole box, inside the margins of the overlay.
  Camera fit(const Snapshot& snapshot, Size size, const View& view, const OverlayText& text,
             const Legends& legends);
  /// The same, with the legends of the snapshot alone.
  Camera fit(const Snapshot& snapshot, Size size, const View& view, const OverlayText& text) {
    return fit(snapshot, size, view, text, AutoRanges().legends(snapshot, view));
  }

  /// Draws a picture of `size`. Throws RunError if OpenGL does not support the size times samples,
  /// and Interrupted after a stop request.
  void draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
            const OverlayText& text, Legends legends);
  /// The same, with the legends of the snapshot alone.
  void draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
            const OverlayText& text) {
    draw(snapshot, camera, size, view, text, AutoRanges().legends(snapshot, view));
  }

 private:
  /// The layers of spheres, which pictures of disks do not need.
  struct SpaceLayers {
    SpaceLayers(const Gl& gl, Blending blending)
        : box(gl), slices(gl), light(gl), spheres(gl, blending), volume(gl, blending), lines(gl) {}
    BoxLayer box;
    SliceLayer slices;
    SphereLight light;
    SphereLayer spheres;
    VolumeLayer volume;
    LineLayer lines;
    std::optional<BodyLayer> bodies;  ///< absent: no fixtures drawn yet
  };
  void draw_lines(const Snapshot& snapshot, const Projection& projection, const View& view,
                  const Legends& legends, const ThemeColours& theme, const DiskColours& colours,
                  const Eye& eye);
  void draw_spheres(const Snapshot& snapshot, const Projection& projection, const View& view,
                    const Legends& legends, const ThemeColours& theme);
  void blend_in_light(bool on);
  void clear(const Projection& projection, const ThemeColours& theme);
  void pause(const Projection& projection) const;
  DiskColours disk_colours(const Snapshot& snapshot, const View& view, const Legends& legends,
                           const ThemeColours& theme) const;
  void draw_layers(const Snapshot& snapshot, const Projection& projection, const View& view,
                   const Legends& legends, const ThemeColours& theme);
  void draw_disks(const Snapshot& snapshot, const Projection& projection, const View& view,
                  const Legends& legends, const ThemeColours& theme);
  void draw_sum(const Snapshot& snapshot, const Projection& projection, const View& view,
                const Legends& legends, const ThemeColours& theme, GLuint target);
  void draw_averaged(const Snapshot& snapshot, const Projection& projection, const View& view,
                     const Legends& legends, const ThemeColours& theme, GLuint target);

  const Gl* gl_;
  int samples_;
  bool transparent_;
  StopRequest stop_;
  std::optional<Canvas> fine_;           ///< supersampled picture; absent: not drawn yet
  std::optional<Canvas> sum_;            ///< sum of pictures; absent: not drawn yet
  std::optional<LightCopy> light_copy_;  ///< OpenGL ES; absent: not used yet
  AverageLayer average_;
  FieldLayer field_;
  GridLayer grid_;
  std::optional<FixtureLayer> fixtures_;  ///< absent: no fixtures of disks drawn yet
  WallLayer walls_;
  TrailLayer trails_;
  DiskLayer disks_;
  ArrowLayer arrows_;
  std::optional<SpaceLayers> space_;  ///< absent: no spheres drawn yet
  Overlay overlay_;
};

}  // namespace clatter
