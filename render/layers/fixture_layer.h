#pragma once

#include <array>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/layers/wall_colours.h"
#include "render/tiling.h"

namespace clatter {

/// Whether a snapshot has obstacles or partitions.
inline bool has_fixtures(const Snapshot& snapshot) {
  return !snapshot.obstacles.empty() || !snapshot.partitions.empty();
}

/// Draws the fixtures of disks, with their images at periodic borders. Obstacles are opaque bodies.
/// Partitions are lines, membranes dashed ones. The patterns of walls show their laws: a static
/// body is hatched, a thermal one glows, and the teeth of a driven one move out of it.
class FixtureLayer {
 public:
  explicit FixtureLayer(const Gl& gl);

  /// Draws the fixtures of a snapshot in the copies of the box.
  void draw(const Snapshot& snapshot, const Projection& projection, const WallColours& colours,
            const Tiling& tiling);

 private:
  // A fixture or an image of it, with the layout of the shader attributes.
  struct Body {
    std::array<float, 4> rectangle;  // around it, drawn pixels
    std::array<float, 4> shape;      // pixel of its origin, radius or 0, first corner
    std::array<float, 4> marks;      // pattern, thickness, length of a tooth, advance
    std::array<float, 2> counts;     // corners, period of dashes
    Colour fill, colour;
  };
  // Where fixtures are drawn, in world units.
  struct Extent {
    Vec2 low, high;
  };

  Body body_of(const FixtureLaw& law, const Snapshot& snapshot, const Projection& projection,
               const WallColours& colours, double thickness, double outline) const;
  void add_obstacle(const Obstacle& obstacle, const Snapshot& snapshot,
                    const Projection& projection, const WallColours& colours, const Extent& extent);
  void add_partition(const Partition& partition, const Snapshot& snapshot,
                     const Projection& projection, const WallColours& colours,
                     const Extent& extent);
  void add_corners(const std::vector<Vec2>& corners, const Vec2& origin, double scale);
  void add_images(Body body, const Vec2& origin, const Vec2& low, const Vec2& high,
                  const Snapshot& snapshot, const Projection& projection, const Extent& extent,
                  const std::array<bool, 2>& repeated);
  void upload_corners();

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;
  Texture corners_texture_;
  std::vector<Body> bodies_;                   ///< reused to avoid allocations
  std::vector<std::array<float, 4>> corners_;  ///< of polygons: place, length along the outline
};

}  // namespace clatter
