#include "tests/engine/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::testing {

template <int D>
double least_distance(const Room<D>& room, const std::vector<Vec<D>>& centres, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < D; ++axis) {
    if (!room.walled[axis]) least = std::min(least, room.box[axis]);
  }
  for (std::size_t i = 0; i < centres.size() && least >= enough; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Vec<D> x = centres[i] - centres[j];
      for (int axis = 0; axis < D; ++axis) {
        if (!room.walled[axis]) x[axis] = std::remainder(x[axis], room.box[axis]);
      }
      least = std::min(least, x.norm());
    }
  }
  return least;
}

template <int D>
bool all_inside(const Room<D>& room, const std::vector<Vec<D>>& centres, double rounding) {
  return std::ranges::all_of(centres, [&](const Vec<D>& r) {
    for (int axis = 0; axis < D; ++axis) {
      const double margin = !room.walled[axis] ? 0.0 : 0.5 * room.diameter - rounding;
      if (r[axis] < margin || r[axis] > room.box[axis] - margin) return false;
    }
    return true;
  });
}

template <int D>
std::vector<std::array<bool, D>> all_walls() {
  std::vector<std::array<bool, D>> all;
  for (int pattern = 0; pattern < 1 << D; ++pattern) {
    std::array<bool, D>& walled = all.emplace_back();
    for (int axis = 0; axis < D; ++axis) walled[axis] = pattern >> axis & 1;
  }
  return all;
}

template double least_distance(const Room<2>&, const std::vector<Vec<2>>&, double);
template bool all_inside(const Room<2>&, const std::vector<Vec<2>>&, double);
template std::vector<std::array<bool, 2>> all_walls<2>();
template double least_distance(const Room<3>&, const std::vector<Vec<3>>&, double);
template bool all_inside(const Room<3>&, const std::vector<Vec<3>>&, double);
template std::vector<std::array<bool, 3>> all_walls<3>();

}  // namespace clatter::testing
