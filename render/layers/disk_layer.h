#pragma once

#include <optional>
#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/palette.h"
#include "render/program.h"

namespace clatter {

/// The value of disk `i` that its colour shows; 0 where it shows nothing.
double disk_value(const Snapshot& snapshot, ColourBy colour_by, std::size_t i);

/// Draws the disks: points, and squares where a disk is larger than the largest point.
class DiskLayer {
 public:
  /// `largest_point` in pixels; absent: what the driver says.
  explicit DiskLayer(const Gl& gl, std::optional<double> largest_point = {});

  /// Draws the snapshot's disks, and those across a periodic border on both sides of it;
  /// `plain` is their colour where it shows nothing.
  void draw(const Snapshot& snapshot, const Projection& projection, ColourBy colour_by,
            const ColourScale& scale, Colour plain);

 private:
  struct Disk {
    float x, y;  ///< centre, pixels
    Colour colour;
  };

  void collect(const Snapshot& snapshot, const Projection& projection, ColourBy colour_by,
               const ColourScale& scale, Colour plain);
  void set_uniforms(const Program& program, const Snapshot& snapshot,
                    const Projection& projection) const;

  const Gl* gl_;
  double largest_point_;
  Program point_;
  Program square_;
  Buffer buffer_;
  VertexArray points_;       ///< the buffer, a disk a vertex
  VertexArray squares_;      ///< the buffer, a disk an instance
  std::vector<Disk> disks_;  ///< those in sight, and their periodic images; kept to save its memory
};

}  // namespace clatter
