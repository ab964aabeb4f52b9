#pragma once

#include <array>

#include "engine/laws/model.h"

namespace clatter {

// Formats for three dimensions have disks at z = 0, in the middle of a layer of one diameter.

/// A vector with three components; those that it lacks are 0. The spin of a disk is along z.
template <class T, int Size>
std::array<T, 3> in_space(const Eigen::Matrix<T, Size, 1>& vector) {
  std::array<T, 3> all{};
  for (int k = 0; k < Size; ++k) all[Size == 1 ? 2 : k] = vector[k];
  return all;
}

/// Edge lengths of the box. The layer of disks is one diameter deep.
template <int D>
std::array<double, 3> extents(const Model<D>& model) {
  std::array<double, 3> all = in_space(model.box);
  if (D == 2) all[2] = model.diameter;
  return all;
}

/// Whether the box is periodic along an axis. The layer of disks is not periodic along z.
template <int D>
bool is_periodic(const Model<D>& model, int axis) {
  return axis < D && model.periodic(axis);
}

}  // namespace clatter
