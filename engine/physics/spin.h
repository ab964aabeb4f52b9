#pragma once

#include <Eigen/Geometry>

#include "engine/vec.h"

namespace clatter {

/// Angular velocity: one number in 2D, a vector in 3D.
template <int D>
using Spin = Eigen::Matrix<double, D*(D - 1) / 2, 1>;

/// Number of components of a spin.
template <int D>
inline constexpr int kSpinSize = D*(D - 1) / 2;

/// n x omega: the velocity, due to a spin omega, of the point at -n from the centre.
template <int D>
Vec<D> cross_spin(const Vec<D>& n, const Spin<D>& spin) {
  static_assert(D == 2 || D == 3);
  if constexpr (D == 2) {
    return {n.y() * spin[0], -n.x() * spin[0]};
  } else {
    return n.cross(spin);
  }
}

/// n x g: the gain in angular momentum about the centre by a momentum -g at the point -n from the
/// centre.
template <int D>
Spin<D> cross(const Vec<D>& n, const Vec<D>& g) {
  static_assert(D == 2 || D == 3);
  if constexpr (D == 2) {
    return Spin<D>(n.x() * g.y() - n.y() * g.x());
  } else {
    return n.cross(g);
  }
}

}  // namespace clatter
