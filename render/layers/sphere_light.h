#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/bodies.h"
#include "render/eye.h"
#include "render/layers/coverage.h"
#include "render/layers/disk_colours.h"

namespace clatter {

/// Draws spheres that are too small on the picture for a shape, as their light and area in each
/// pixel. Nearer ones hide the share of a pixel that they cover. Each has the mean light of a
/// sphere without neighbours. In a mixture these are all spheres behind the plane across the view
/// from which on the largest ones are too small.
class SphereLight {
 public:
  /// Whether it draws a sphere, by its centre in view coordinates. `largest` is the radius of the
  /// largest spheres.
  static bool draws(const Eye& eye, const Vec3& centre, double largest) {
    return eye.pixels(centre, largest) < Coverage::kLargestRadius;
  }
  /// Whether some spheres in the box of a snapshot may be so small.
  static bool draws(const Eye& eye, const Snapshot& snapshot);

  explicit SphereLight(const Gl& gl) : gl_(&gl), light_(gl) {}

  /// Draws the small spheres with their centre in the slab and in front of all slices and
  /// bodies. Those on a periodic border have no image.
  void draw(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
            const DiskColours& colours, const std::optional<Slab>& slab,
            std::span<const Slice> slices, const Bodies& bodies = {});

 private:
  struct Small {
    float x, y;      // centre, drawn pixels
    float radius;    // drawn pixels
    float distance;  // along the view
    std::uint32_t number;
  };

  void collect(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
               const std::optional<Slab>& slab, std::span<const Slice> slices,
               const Bodies& bodies);
  void sort();

  const Gl* gl_;
  LightLayer light_;
  Coverage coverage_;
  std::vector<Small> small_, sorted_;  ///< reused to avoid allocations
};

}  // namespace clatter
