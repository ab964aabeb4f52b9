#pragma once

#include <optional>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/gl_object.h"
#include "render/gl/shader_program.h"
#include "render/layers/coverage.h"
#include "render/layers/disk_colours.h"
#include "render/layers/swept_layer.h"
#include "render/tiling.h"

namespace clatter {

/// Draws the disks as points, or as squares if the largest disk is larger than the largest point.
/// Disks below Coverage::kLargestRadius are drawn through their coverage. Disks of known angle have
/// a mark that turns with them. With an exposure time disks have motion blur and no mark.
class DiskLayer {
 public:
  /// `largest_point` is the largest point size in pixels; absent: the limit of the driver.
  explicit DiskLayer(const Gl& gl, std::optional<double> largest_point = {});

  /// Draws the disks of the snapshot, and their images in the copies of the box, into the bound
  /// framebuffer, which must be sRGB. Disks that cross a periodic border are drawn on both sides.
  void draw(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours,
            const Tiling& tiling = {});

 private:
  struct Disk {
    float x, y;   ///< centre, drawn pixels
    float angle;  ///< angle of rotation, rad
    Light light;
  };

  void draw_coverage(const Snapshot& snapshot, const Projection& projection,
                     const DiskColours& colours, const Tiling& tiling);
  void cover_paths(const Snapshot& snapshot, const Projection& projection,
                   const DiskColours& colours, const Tiling& tiling, double largest);
  void collect(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours,
               const Tiling& tiling);
  void draw_shapes(const Snapshot& snapshot, const Projection& projection,
                   const DiskColours& colours, const Tiling& tiling);
  void use(ProgramVariants& programs, const Snapshot& snapshot, const Projection& projection,
           Blending blending, float faintness, int margin);

  const Gl* gl_;
  double largest_point_;
  ProgramVariants point_;
  ProgramVariants square_;
  SweptLayer swept_;
  LightLayer light_;
  Buffer buffer_;
  InstanceNumbers radii_of_disks_;
  VertexArray points_;        ///< reads the buffer, one vertex per disk
  VertexArray squares_;       ///< reads the buffer, one instance per disk
  std::vector<Disk> disks_;   ///< visible disks and periodic images; reused to avoid allocations
  std::vector<float> radii_;  ///< of these, drawn pixels; of disks that are alike one for all
  Coverage coverage_;         ///< reused to avoid allocations
};

}  // namespace clatter
