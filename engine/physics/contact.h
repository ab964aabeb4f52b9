#pragma once

#include "engine/physics/encounter.h"
#include "engine/physics/flight.h"

namespace clatter {

/// Velocities below this share of the partners' speeds are rounding: the error of one collision's
/// velocities, a few units in the last place of each.
inline constexpr double kApproachRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// Time at which the disks of two flights touch, or kNever; see encounter_time. `shift` is added to
/// a.r - b.r and selects the periodic image. Disks that touch already collide at once, but only if
/// they approach faster than the rounding of their velocities: otherwise the rounding left by a
/// collision would be another one, for ever.
template <int D>
double contact_time(const Flight<D>& a, const Flight<D>& b, const Vec<D>& shift, double diameter) {
  const double time = encounter_time<D>(a.r.data(), a.v.data(), a.time, b.r.data(), b.v.data(),
                                        b.time, shift.data(), diameter);
  if (time != kTouching) return time;
  const double start = a.time > b.time ? a.time : b.time;
  const Vec<D> x = (a.at(start) - b.at(start)) + shift;
  const double rounding = kApproachRounding * diameter * (a.v.norm() + b.v.norm());
  return x.dot(a.v - b.v) < -rounding ? start : kNever;
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
