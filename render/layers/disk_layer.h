#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/layers/coverage_layer.h"
#include "render/palette.h"
#include "render/program.h"

namespace clatter {

/// The value of disk `i` that its colour shows; 0 where it shows nothing.
double disk_value(const Snapshot& snapshot, ColourBy colour_by, std::size_t i);

/// Which colours disks have.
struct DiskColours {
  ColourBy colour_by = ColourBy::None;
  ColourScale scale;  ///< from the value that it shows
  Colour plain;       ///< where it shows nothing

  /// That of disk `i`.
  Colour of(const Snapshot& snapshot, std::size_t i) const;
};

/// Draws the disks: points, squares where a disk is larger than the largest point, and where disks
/// are too small to have a shape the light of all of them together.
class DiskLayer {
 public:
  /// `largest_point` in pixels; absent: what the driver says.
  explicit DiskLayer(const Gl& gl, std::optional<double> largest_point = {});

  /// Draws the snapshot's disks, and those across a periodic border on both sides of it, into what
  /// is bound, which must be of sRGB.
  void draw(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours);

 private:
  struct Disk {
    float x, y;                          ///< centre, pixels
    std::array<std::uint16_t, 4> light;  ///< linear colour and opacity, of 65535
  };

  void draw_coverage(const Snapshot& snapshot, const Projection& projection,
                     const DiskColours& colours);
  void draw_shapes(const Snapshot& snapshot, const Projection& projection,
                   const DiskColours& colours);
  void set_uniforms(const Program& program, const Snapshot& snapshot,
                    const Projection& projection) const;

  const Gl* gl_;
  double largest_point_;
  Program point_;
  Program square_;
  CoverageLayer coverage_layer_;
  Buffer buffer_;
  VertexArray points_;       ///< the buffer, a disk a vertex
  VertexArray squares_;      ///< the buffer, a disk an instance
  std::vector<Disk> disks_;  ///< those in sight, and their periodic images; kept to save its memory
  Coverage coverage_;        ///< likewise
};

}  // namespace clatter
