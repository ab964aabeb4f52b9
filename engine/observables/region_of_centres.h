#pragma once

#include <algorithm>

#include "engine/laws/model.h"

namespace clatter {

/// Length of the region of centres along an axis: the period, or the distance between wall planes.
template <int D>
double room_of(const Model<D>& model, int axis) {
  return model.periodic(axis) ? model.box[axis]
                              : model.wall_plane(axis, 1) - model.wall_plane(axis, 0);
}

/// The range of distances, shortened to half the shortest period and to the shortest distance
/// between walls. Expected numbers of longer distances would need other terms.
template <int D>
double longest_distance(const Model<D>& model, double range) {
  for (int axis = 0; axis < D; ++axis) {
    range = std::min(range, (model.periodic(axis) ? 0.5 : 1.0) * room_of(model, axis));
  }
  return range;
}

}  // namespace clatter
