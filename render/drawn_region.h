#pragma once

#include <optional>

#include "engine/picture/snapshot.h"
#include "render/eye.h"

namespace clatter {

/// The box of world positions in which spheres are drawn: between the faces of the walls and the
/// planes of a slab.
struct DrawnRegion {
  Vec3 low, high;

  /// Whether a sphere is not completely inside.
  bool cuts(const Vec3& centre, double radius) const;
};

/// The region of a snapshot; unbounded at walls, because spheres do not cross them. Without
/// `periodic_faces` also at periodic borders.
DrawnRegion drawn_region(const Snapshot& snapshot, const std::optional<Slab>& slab,
                         bool periodic_faces);

/// Calls `visit` with the position of each image of a sphere that reaches into the box.
template <class Visit>
void visit_images(const Snapshot& snapshot, const Vec3& position, double radius, Visit visit) {
  const auto shifted = [&](auto&& self, int axis, const Vec3& place) -> void {
    if (axis == 3) return visit(place);
    self(self, axis + 1, place);
    if (snapshot.walls[2 * axis]) return;
    const double length = snapshot.box[axis];
    Vec3 image = place;
    if (place[axis] < radius) {
      image[axis] += length;
    } else if (place[axis] > length - radius) {
      image[axis] -= length;
    } else {
      return;
    }
    self(self, axis + 1, image);
  };
  shifted(shifted, 0, position);
}

}  // namespace clatter
