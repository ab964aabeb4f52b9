#pragma once

#include <span>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/eye.h"
#include "render/gl/shader_program.h"
#include "render/layers/disk_colours.h"

namespace clatter {

/// A straight line in space.
struct Line {
  Vec3 from, to;       ///< world positions
  double width = 1.0;  ///< on the picture, drawn pixels
  Colour colour;
};

/// Draws straight lines in space with a constant width on the picture. Spheres hide them where the
/// depth test is enabled.
class LineLayer {
 public:
  explicit LineLayer(const Gl& gl);

  /// Draws lines in a box of spheres. `dash` is the period of dashes in drawn pixels; 0: none.
  void draw(std::span<const Line> lines, const Vec3& box, const Projection& projection,
            const Eye& eye, double dash = 0.0);

 private:
  struct Vertex {
    float x, y, depth;          // drawn pixels, and 0..1
    float across, along, half;  // drawn pixels
    Colour colour;
  };

  void add(const Line& line, const Eye& eye, double depth_range);

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
  std::vector<Vertex> corners_;  ///< six of each line, two triangles; reused to avoid allocations
};

/// The paths of the spheres of these flights over the last `time`, in the colours of the spheres.
/// They fade out with age. `width` is in drawn pixels.
std::vector<Line> trail_lines(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                              const DiskColours& colours, double time, double width);

/// The arrows of a map, each centred on its cell. `scale` is the length of an arrow in world units
/// per unit of its value; no arrow is longer than two cells. `width` is in drawn pixels.
std::vector<Line> arrow_lines(const ArrowMap& map, const Eye& eye, double scale, double width,
                              Colour colour);

}  // namespace clatter
