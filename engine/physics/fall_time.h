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
inline WayOut exit_time(double above, double below, double speed, double acceleration) {
  const bool upwards = acceleration > 0.0;
  const double a = std::fabs(acceleration);
  const double falling = upwards ? speed : -speed;
  const double depth = std::max(0.0, upwards ? below : above);
  const double height = std::max(0.0, upwards ? above : below);
  const double square = falling * falling;
  const double at_height = square - 2.0 * a * height;
  const bool gets_there = (falling < 0.0) & (at_height > 0.0);
  const double root = std::sqrt(gets_there ? at_height : square + 2.0 * a * depth);
  const bool turns = (falling <= 0.0) & !gets_there;
  const double numerator = turns ? root - falling : 2.0 * (gets_there ? height : depth);
  const double denominator = turns ? a : root + std::fabs(falling);
  return {numerator / denominator, upwards != gets_there};
}

}  // namespace clatter
