#pragma once

#include <algorithm>
#include <cmath>

#include "engine/physics/pair_contact.h"

namespace clatter {

/// Time from now at which gap + speed t + acceleration t^2/2 first passes zero downwards, or
/// kNever. A gap below zero counts as rounding and is set to zero. Without acceleration the result
/// has the bits of gap / -speed.
///
/// The form of the root is the one that adds numbers of one sign.
inline double fall_time(double gap, double speed, double acceleration) {
  if (speed >= 0.0 && acceleration >= 0.0) return kNever;
  if (!(gap > 0.0)) gap = 0.0;
  const double discriminant = speed * speed - 2.0 * acceleration * gap;
  if (speed > 0.0) return (speed + std::sqrt(discriminant)) / -acceleration;
  if (gap == 0.0) return 0.0;
  if (acceleration == 0.0) return gap / -speed;
  return discriminant > 0.0 ? 2.0 * gap / (std::sqrt(discriminant) - speed) : kNever;
}

/// The exit from the region between two planes.
struct WayOut {
  double time;  ///< from now; infinite or NaN if no plane is reached
  bool upper;   ///< whether the exit is through the upper plane
};

/// The first exit of a body at the distance `above` from the lower and `below` from the upper
/// plane. Distances below zero count as rounding and are set to zero. The acceleration must not be
/// zero.
///
/// As fall_time(), but branch-free, because the speed's sign and the plane are unpredictable.
/// Vectors of two equal numbers make compilers select without branches.
inline WayOut exit_time(double above, double below, double speed, double acceleration) {
  using Number = double __attribute__((vector_size(16)));
  const auto number = [](double value) { return Number{value, value}; };
  const Number zero{}, a = number(std::fabs(acceleration)), to_lower = number(above),
                       to_upper = number(below);
  const auto upwards = number(acceleration) > zero;
  const Number falling = upwards ? number(speed) : number(-speed);
  const auto positive = [&](const Number& value) { return value > zero ? value : zero; };
  const Number depth = positive(upwards ? to_upper : to_lower);
  const Number height = positive(upwards ? to_lower : to_upper);
  const Number square = falling * falling;
  const Number at_height = square - 2.0 * a * height;
  const auto gets_there = (falling < zero) & (at_height > zero);
  const Number discriminant = gets_there ? at_height : square + 2.0 * a * depth;
  const Number root = number(std::sqrt(discriminant[0]));
  const auto turns = (falling <= zero) & ~gets_there;
  const Number numerator = turns ? root - falling : 2.0 * (gets_there ? height : depth);
  const Number denominator = turns ? a : root + number(std::fabs(speed));
  return {numerator[0] / denominator[0], upwards[0] != gets_there[0]};
}

}  // namespace clatter
