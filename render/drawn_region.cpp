#include "render/drawn_region.h"

#include <algorithm>

namespace clatter {

static constexpr double kFar = 1e9;  // beyond every box

bool DrawnRegion::cuts(const Vec3& centre, double radius) const {
  return (centre.array() - radius < low.array()).any() ||
         (centre.array() + radius > high.array()).any();
}

DrawnRegion drawn_region(const Snapshot& snapshot, const std::optional<Slab>& slab,
                         bool periodic_faces) {
  DrawnRegion region{Vec3::Constant(-kFar), Vec3::Constant(kFar)};
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic_faces || snapshot.walls[2 * axis]) continue;
    region.low[axis] = 0.0;
    region.high[axis] = snapshot.box[axis];
  }
  if (slab) {
    const auto axis = static_cast<int>(slab->axis);
    region.low[axis] = std::max(region.low[axis], slab->from);
    region.high[axis] = std::min(region.high[axis], slab->to);
  }
  return region;
}

}  // namespace clatter
