#pragma once

#include <cmath>

#include "engine/scene/scene.h"
#include "engine/vec.h"

namespace clatter {

/// Velocity after a static or driven wall, Eq. (3.1): v_n' = alpha_w |v_n| + v_dr along the wall's
/// normal, which points into the box along +-`axis` (`inward` = +1 or -1); the rest stays.
template <int D>
Vec<D> reflect(Vec<D> v, int axis, double inward, double restitution, double drive_speed) {
  v[axis] = inward * (restitution * std::fabs(v[axis]) + drive_speed);
  return v;
}

/// Velocity after a thermal wall of temperature T_w, section 3: the normal component has the
/// flux-weighted density (v/T_w) exp(-v^2/2T_w), v = sqrt(-2 T_w ln U), the others are Gaussian of
/// variance T_w. `uniform` lies in (0,1), `normals` holds D - 1 standard normal variates.
template <int D>
Vec<D> emit(int axis, double inward, double temperature, double uniform, const double* normals) {
  Vec<D> v;
  for (int k = 0; k < D; ++k) {
    v[k] = k == axis ? inward * std::sqrt(-2.0 * temperature * std::log(uniform))
                     : std::sqrt(temperature) * *normals++;
  }
  return v;
}

}  // namespace clatter
