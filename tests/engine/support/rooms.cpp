#include "tests/engine/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::testing {

double least_distance(const Room<2>& room, const std::vector<Vec2>& centres, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (!room.walled[axis]) least = std::min(least, room.box[axis]);
  }
  for (std::size_t i = 0; i < centres.size() && least >= enough; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Vec2 x = centres[i] - centres[j];
      for (int axis = 0; axis < 2; ++axis) {
        if (!room.walled[axis]) x[axis] = std::remainder(x[axis], room.box[axis]);
      }
      least = std::min(least, x.norm());
    }
  }
  return least;
}

bool all_inside(const Room<2>& room, const std::vector<Vec2>& centres, double rounding) {
  return std::ranges::all_of(centres, [&](const Vec2& r) {
    for (int axis = 0; axis < 2; ++axis) {
      const double margin = !room.walled[axis] ? 0.0 : 0.5 * room.diameter - rounding;
      if (r[axis] < margin || r[axis] > room.box[axis] - margin) return false;
    }
    return true;
  });
}

}  // namespace clatter::testing
