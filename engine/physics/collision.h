#pragma once

#include "engine/vec.h"

namespace clatter {

/// Momentum that disk 1 gains in a collision of smooth disks, Eq. (2.4) with beta = -1:
/// -(1 + alpha)/2 (n.g) n, for x = r_1 - r_2 at contact and g = v_1 - v_2; disk 2 gains its
/// negative. Dividing by x.x instead of a^2 keeps elastic collisions elastic to rounding whatever
/// the rounding of x.
template <int D>
Vec<D> collision_impulse(const Vec<D>& x, const Vec<D>& g, double restitution) {
  return x * (-0.5 * (1.0 + restitution) * x.dot(g) / x.squaredNorm());
}

}  // namespace clatter
