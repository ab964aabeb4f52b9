#pragma once

#include <cmath>

#include "engine/physics/collision.h"
#include "engine/physics/elementary.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// Velocity after a static or driven wall (theory 4.1): v_n' = alpha_w |v_n| + v_dr along the
/// wall's normal, which points into the box along +-`axis` (`inward` = +1 or -1). Both velocities
/// are relative to the wall, which moves at `wall_velocity` along the normal. The other components
/// stay.
template <int D>
Vec<D> reflect(Vec<D> v, int axis, double inward, double restitution, double drive_speed,
               double wall_velocity = 0.0) {
  const double approach = std::fabs(v[axis] - inward * wall_velocity);
  v[axis] = inward * (restitution * approach + drive_speed + wall_velocity);
  return v;
}

/// Velocity after a wall that moves (theory 4.2): v_n' = -alpha_w v_n + (1 + alpha_w) u, the
/// reflection in the wall's frame, where u = `wall_velocity` along the normal into the box. A wall
/// that overtakes a particle (0 < v_n < u) hits it from behind.
template <int D>
Vec<D> reflect_moving(Vec<D> v, int axis, double inward, double restitution, double wall_velocity) {
  v[axis] = inward * (1.0 + restitution) * wall_velocity - restitution * v[axis];
  return v;
}

/// Gain of a particle by friction at a wall (theory 4.5): the momentum -2 eta_w g_t and the spin (4
/// eta_w/(q a)) n x g_t, with g_t from the velocity and spin before. `after` is the velocity after
/// a smooth wall: Coulomb's bound uses the true normal impulse |v_n' - v_n| of every kind of wall.
template <int D>
Impulse<D> wall_friction(const Vec<D>& before, const Vec<D>& after, const Spin<D>& spin, int axis,
                         double inward, const ContactLaw& law, double inertia, double diameter) {
  const Vec<D> n = inward * Vec<D>::Unit(axis);
  const double normal_change = std::fabs(after[axis] - before[axis]);
  const Impulse<D> friction =
      friction_impulse<D>(n, before, spin, normal_change, law, inertia, diameter);
  return {2.0 * friction.momentum, 2.0 * friction.spin};
}

/// Velocity after a thermal wall of temperature T_w (theory 4.7): the normal component has the
/// flux-weighted density (v/T_w) exp(-v^2/2T_w), v = sqrt(-2 T_w ln U), the others are Gaussian of
/// variance T_w. `uniform` is in (0,1); `normals` holds D - 1 standard normal variates.
template <int D>
Vec<D> emit(int axis, double inward, double temperature, double uniform, const double* normals) {
  Vec<D> v;
  for (int k = 0; k < D; ++k) {
    v[k] = k == axis ? inward * std::sqrt(-2.0 * temperature * natural_log(uniform))
                     : std::sqrt(temperature) * *normals++;
  }
  return v;
}

/// Spin after a thermal wall (theory 4): Gaussian of variance T_w/I per component.
/// `normals` holds one standard normal variate per component.
template <int D>
Spin<D> emit_spin(double temperature, double inertia, double diameter, const double* normals) {
  return std::sqrt(temperature / moment_of_inertia(inertia, diameter)) *
         Eigen::Map<const Spin<D>>(normals);
}

}  // namespace clatter
