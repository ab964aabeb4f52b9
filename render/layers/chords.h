#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/gl/gl_object.h"
#include "render/layers/disk_colours.h"
#include "render/tiling.h"

namespace clatter {

/// A straight part of the path of a disk on the picture, at constant speed.
struct Chord {
  std::uint32_t disk = 0;
  Vec2 start = {0.0, 0.0}, end = {0.0, 0.0};  ///< centre of the disk, drawn pixels
  double from = 0.0, to = 0.0;                ///< times relative to the snapshot, from < to <= 0
};

/// The visible paths of the disks of these flights and of their periodic images in all copies of
/// the box over the last `time`. Chords deviate from a parabola by at most 1/16 pixel.
std::vector<Chord> chords(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                          const Projection& projection, double time, const Tiling& tiling = {});

/// A rectangle around a line segment. A vertex shader reads `pairs` as attributes 0 to 2, with the
/// position of the rectangle, and `light` as attribute 3.
struct Stroke {
  std::array<Eigen::Vector2f, 3> pairs;
  Light light;
};

/// Draws strokes, as instances of one rectangle.
class Strokes {
 public:
  explicit Strokes(const Gl& gl);

  /// Draws strokes with the program in use. The vertex shader reads the widths, in pixels, as
  /// attribute 4. They are one of each stroke, or one for all.
  void draw(const std::vector<Stroke>& strokes, const std::vector<float>& widths);

 private:
  const Gl* gl_;
  Buffer buffer_;
  InstanceNumbers widths_;
  VertexArray vertices_;
};

}  // namespace clatter
