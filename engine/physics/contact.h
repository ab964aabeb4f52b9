#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/physics/flight.h"

namespace clatter {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Velocities below this share of the partners' speeds are rounding: the error of one collision's
/// velocities, a few units in the last place of each.
inline constexpr double kApproachRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// |x ^ v|^2, the squared area that two vectors span: (x_0 v_1 - x_1 v_0)^2 in two dimensions.
template <int D>
double wedge_squared(const Vec<D>& x, const Vec<D>& v) {
  double sum = 0.0;
  for (int k = 0; k < D; ++k) {
    for (int l = k + 1; l < D; ++l) {
      const double part = x[k] * v[l] - x[l] * v[k];
      sum += part * part;
    }
  }
  return sum;
}

/// Time at which the disks of two flights touch, or kNever. `shift` is added to a.r - b.r and
/// selects the periodic image. A function of the two flights alone, and the same to the last bit
/// when they are exchanged and the shift is negated, so that it does not matter who asks or when.
///
/// With x and g the relative position and velocity where the later flight starts, contact is the
/// first root of |x + g t| = a. Its discriminant is taken as g^2 a^2 - |x ^ g|^2, which unlike
/// (x.g)^2 - g^2 (x^2 - a^2) loses nothing when the disks start far apart. Disks that already touch
/// collide at once, but only if they approach faster than the rounding of their velocities:
/// otherwise the rounding left by a collision would be another one, for ever.
template <int D>
double contact_time(const Flight<D>& a, const Flight<D>& b, const Vec<D>& shift, double diameter) {
  const double start = std::max(a.time, b.time);
  const Vec<D> x = (a.at(start) - b.at(start)) + shift;
  const Vec<D> g = a.v - b.v;
  const double approach = x.dot(g);
  if (!(approach < 0.0)) return kNever;
  const double speed_squared = g.squaredNorm();
  const double discriminant = speed_squared * (diameter * diameter) - wedge_squared<D>(x, g);
  if (!(discriminant > 0.0)) return kNever;
  const double gap = x.squaredNorm() - diameter * diameter;
  if (gap <= 0.0) {
    const double rounding = kApproachRounding * diameter * (a.v.norm() + b.v.norm());
    return approach < -rounding ? start : kNever;
  }
  return start + gap / (std::sqrt(discriminant) - approach);
}

/// Time at which a flight reaches the plane at `plane` along `axis`, where `inward` (+1 or -1) is
/// the direction of the wall's normal into the box, or kNever. A disk that already touches the wall
/// hits it at once if it moves outwards.
template <int D>
double plane_contact_time(const Flight<D>& flight, int axis, double plane, double inward) {
  const double outward_speed = -inward * flight.v[axis];
  if (!(outward_speed > 0.0)) return kNever;
  const double gap = inward * (flight.r[axis] - plane);
  return gap > 0.0 ? flight.time + gap / outward_speed : flight.time;
}

}  // namespace clatter
