#pragma once

#include <functional>
#include <optional>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/colour_range.h"
#include "render/layers/arrow_layer.h"
#include "render/layers/average_layer.h"
#include "render/layers/disk_layer.h"
#include "render/layers/field_layer.h"
#include "render/layers/grid_layer.h"
#include "render/layers/overlay.h"
#include "render/layers/trail_layer.h"
#include "render/layers/wall_layer.h"

namespace clatter {

/// The ends of automatic colour ranges; 0: there is nothing to choose one by.
struct RangeEnds {
  double disks = 0.0;
  double field = 0.0;
  double arrows = 0.0;
};

/// The round ends that fit a snapshot by itself.
RangeEnds range_ends(const Snapshot& snapshot, const View& view);

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, RangeEnds& range) {
  auto& [disks, field, arrows] = range;
  io(disks, field, arrows);
}

/// Draws snapshots into the framebuffer that is bound. Automatic colour ranges follow the snapshots
/// it is given, until they are fixed; so a film has a Renderer of its own.
class Renderer {
 public:
  /// Compiles the shaders; throws RunError. `gl` must outlive the renderer. All but the overlay is
  /// drawn `samples` times larger and averaged in linear light. Without a background,
  /// `transparent`, pictures have their opacity as alpha, and colours times it.
  explicit Renderer(const Gl& gl, int samples = 1, bool transparent = false);

  /// From now on automatic colour ranges have these ends.
  void fix(const RangeEnds& ends);

  /// The camera that shows the whole box, clear of what the overlay writes.
  Camera fit(const Snapshot& snapshot, Size size, const View& view, const OverlayText& text);

  /// Draws a picture of `size`. Throws RunError where it is too large for its samples.
  void draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
            const OverlayText& text);

 private:
  /// The range of a quantity's colours, as far as it follows the snapshots.
  struct Followed {
    Label label;
    SteadyExtent followed;
    double fixed = 0.0;  ///< the end, once and for all; 0: it follows

    /// `extent` tells the robust extent of what is shown, and is asked only where it matters.
    double end(const Label& shown, const std::function<double()>& extent, bool hold = false);

    Legend legend(const Label& shown, const ColourRange& range, ColourMap map,
                  const std::function<double()>& extent, bool lockable);
  };
  Legends legends_for(const Snapshot& snapshot, const View& view, double scale);
  void draw_world(const Snapshot& snapshot, const Projection& projection, const View& view,
                  const Legends& legends, const ThemeColours& theme);
  void draw_averaged(const Snapshot& snapshot, const Projection& projection, const View& view,
                     const Legends& legends, const ThemeColours& theme, GLuint target);

  const Gl* gl_;
  int samples_;
  bool transparent_;
  std::optional<Canvas> fine_;  ///< what has several samples a pixel; absent: not drawn yet
  AverageLayer average_;
  FieldLayer field_;
  GridLayer grid_;
  WallLayer walls_;
  TrailLayer trails_;
  DiskLayer disks_;
  ArrowLayer arrows_;
  Overlay overlay_;
  Followed disk_range_;
  Followed field_range_;
  Followed arrow_range_;
};

}  // namespace clatter
