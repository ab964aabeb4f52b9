#pragma once

#include <optional>
#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/coverage.h"
#include "render/layers/disk_colours.h"
#include "render/layers/swept_layer.h"

namespace clatter {

/// Draws the disks: points, squares where a disk is larger than the largest point, and where disks
/// are too small to have a shape the light of all of them together. Those whose angle is known have
/// a mark that turns with them; those that the picture shows over a time are blurred by their
/// motion, and have none.
class DiskLayer {
 public:
  /// `largest_point` in pixels; absent: what the driver says.
  explicit DiskLayer(const Gl& gl, std::optional<double> largest_point = {});

  /// Draws the snapshot's disks, and those across a periodic border on both sides of it, into what
  /// is bound, which must be of sRGB.
  void draw(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours);

 private:
  struct Disk {
    float x, y;   ///< centre, pixels
    float angle;  ///< by which it has turned
    Light light;
  };

  void draw_coverage(const Snapshot& snapshot, const Projection& projection,
                     const DiskColours& colours);
  void cover_paths(const Snapshot& snapshot, const Projection& projection,
                   const DiskColours& colours);
  void draw_shapes(const Snapshot& snapshot, const Projection& projection,
                   const DiskColours& colours);
  void set_uniforms(const Program& program, const Snapshot& snapshot, const Projection& projection,
                    Blending blending, int margin) const;

  const Gl* gl_;
  double largest_point_;
  Program point_;
  Program square_;
  SweptLayer swept_;
  LightLayer light_;
  Texture areas_;
  Buffer buffer_;
  VertexArray points_;       ///< the buffer, a disk a vertex
  VertexArray squares_;      ///< the buffer, a disk an instance
  std::vector<Disk> disks_;  ///< those in sight, and their periodic images; kept to save its memory
  Coverage coverage_;        ///< likewise
};

}  // namespace clatter
