#pragma once

#include <cmath>
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
  // Images above and below in a sheared box have slid along x.
  const auto above = [&](auto&& self, const Vec3& place, double boxes) -> void {
    Vec3 image = place;
    image[1] += boxes * snapshot.box[1];
    image[0] += boxes * snapshot.offset;
    image[0] -= std::floor(image[0] / snapshot.box[0]) * snapshot.box[0];
    self(self, 0, image);
  };
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
  if (snapshot.slide == 0.0 && snapshot.offset == 0.0) return shifted(shifted, 0, position);
  const auto level = [&](auto&& self, int axis, const Vec3& place) -> void {
    if (axis == 1) axis = 2;
    if (axis == 3) return visit(place);
    self(self, axis + 1, place);
    if (snapshot.walls[2 * axis]) return;
    const double length = snapshot.box[axis];
    if (place[axis] >= radius && place[axis] <= length - radius) return;
    Vec3 image = place;
    image[axis] += place[axis] < radius ? length : -length;
    self(self, axis + 1, image);
  };
  above(level, position, 0.0);
  if (position[1] < radius) above(level, position, 1.0);
  if (position[1] > snapshot.box[1] - radius) above(level, position, -1.0);
}

}  // namespace clatter
