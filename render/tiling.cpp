#include "render/tiling.h"

#include <algorithm>
#include <cmath>

namespace clatter {

// The largest number of copies on each side.
static double most_copies(const Snapshot& snapshot) {
  constexpr double kMostCopies = 8.0, kMostDisks = 4e6;
  const double disks = std::max(1.0, static_cast<double>(snapshot.count()));
  const double boxes_along_axis = std::sqrt(kMostDisks / disks);
  return std::clamp(std::floor(0.5 * (boxes_along_axis - 1.0)), 1.0, kMostCopies);
}

Tiling tiling_of(const Snapshot& snapshot, const Projection& projection, const View& view) {
  Tiling tiling;
  if (!view.tiling) return tiling;
  tiling.faintness = 0.5f;
  const double most = most_copies(snapshot);
  const Vec2 half =
      0.5 / projection.scale() * Vec2(projection.drawn().width, projection.drawn().height);
  for (int axis : {0, 1}) {
    if (snapshot.walls[2 * axis]) continue;
    const auto copy_at = [&](double place) {
      return static_cast<int>(std::clamp(std::floor(place / snapshot.box[axis]), -most, most));
    };
    tiling.first[axis] = std::min(copy_at(projection.camera.centre[axis] - half[axis]), 0);
    tiling.last[axis] = std::max(copy_at(projection.camera.centre[axis] + half[axis]), 0);
  }
  return tiling;
}

}  // namespace clatter
