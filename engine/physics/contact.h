#pragma once

#include <cmath>
#include <limits>

#include "engine/physics/fall_time.h"
#include "engine/physics/flight.h"
#include "engine/physics/pair_contact.h"

namespace clatter {

/// Relative velocities below this share of the partners' speeds count as rounding. One collision's
/// velocities have an error of a few units in the last place.
inline constexpr double kApproachRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// Time at which the particles of two flights touch, or kNever; see pair_contact_time. `shift` is
/// added to a.r - b.r and selects the periodic image, `distance` that of the centres at contact. In
/// a sheared box the shift is that at time 0, and moves along x at the velocity `slide`.
/// Particles that already touch collide at once, but only if they approach faster than the rounding
/// of their velocities. Otherwise the rounding of a collision would cause further collisions
/// without end.
template <int D>
double contact_time(const Flight<D>& a, const Flight<D>& b, const Vec<D>& shift, double distance,
                    const Vec<D>& gravity, double slide = 0.0) {
  const double* const slides = slide != 0.0 ? &slide : nullptr;
  const double time =
      pair_contact_time<D, true>(a.r.data(), a.v.data(), a.time, b.r.data(), b.v.data(), b.time,
                                 shift.data(), distance, gravity.data(), slides);
  if (time != kTouching) return time;
  const double start = a.time > b.time ? a.time : b.time;
  const Vec<D> v_a = a.velocity_at(start, gravity);
  const Vec<D> v_b = b.velocity_at(start, gravity);
  Vec<D> x = (a.at(start, gravity) - b.at(start, gravity)) + shift;
  Vec<D> g = v_a - v_b;
  if (slides) {
    x[0] += slide * start;
    g[0] += slide;
  }
  const double rounding = kApproachRounding * distance * (v_a.norm() + v_b.norm());
  return x.dot(g) < -rounding ? start : kNever;
}

/// Time at which a flight reaches the plane at coordinate `plane` along `axis`, or kNever. `inward`
/// (+1 or -1) is the direction of the wall's normal into the box. A particle that already touches
/// the wall hits it at once if it moves outwards, or if it is at rest and gravity pulls it
/// outwards.
template <int D>
double plane_contact_time(const Flight<D>& flight, int axis, double plane, double inward,
                          const Vec<D>& gravity) {
  return flight.time + fall_time(inward * (flight.r[axis] - plane), inward * flight.v[axis],
                                 inward * gravity[axis]);
}

/// Time at which a particle touches a piston that slides along an axis, or kNever. `distance` is
/// that of their middles at contact. The particle stays on the side where the later of the two
/// flights begins. Partners that touch and approach within the rounding of their velocities do not
/// collide at once.
template <int D>
double piston_contact_time(const Flight<D>& particle, const PistonFlight& piston, int axis,
                           double distance, const Vec<D>& gravity) {
  const double start = particle.time > piston.time ? particle.time : piston.time;
  const double way = particle.at(start, gravity)[axis] - piston.at(start);
  const double side = way < 0.0 ? -1.0 : 1.0;
  const double of_particle = particle.velocity_at(start, gravity)[axis];
  const double of_piston = piston.velocity_at(start);
  const double gap = side * way - distance;
  const double rounding = kApproachRounding * (std::fabs(of_particle) + std::fabs(of_piston));
  double speed = side * (of_particle - of_piston);
  if (!(gap > 0.0) && std::fabs(speed) <= rounding) speed = 0.0;
  return start + fall_time(gap, speed, side * (gravity[axis] - piston.acceleration));
}

}  // namespace clatter
