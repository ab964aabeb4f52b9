#pragma once

#include <algorithm>
#include <cmath>

#include "engine/physics/pair_contact.h"

namespace clatter {

/// Time from now at which gap + speed t + acceleration t^2/2 first passes zero downwards, or
/// kNever. A gap below zero is taken as rounding, that is as zero; with no acceleration the result
/// has the bits of gap / -speed.
///
/// Of the two forms of the root each is used where it adds numbers of one sign.
inline double fall_time(double gap, double speed, double acceleration) {
  if (speed >= 0.0 && acceleration >= 0.0) return kNever;
  if (!(gap > 0.0)) gap = 0.0;
  const double discriminant = speed * speed - 2.0 * acceleration * gap;
  if (speed > 0.0) return (speed + std::sqrt(discriminant)) / -acceleration;
  if (gap == 0.0) return 0.0;
  if (acceleration == 0.0) return gap / -speed;
  return discriminant > 0.0 ? 2.0 * gap / (std::sqrt(discriminant) - speed) : kNever;
}

/// The way out from between two planes.
struct WayOut {
  double time;  ///< from now; infinite, or not a number, where there is no plane to fall to
  bool upper;   ///< through which plane
};

/// The first way out of a body `above` the lower and `below` the upper of two planes; these are
/// distances, of which those below zero are taken as rounding, that is as zero. The acceleration is
/// not zero.
///
/// As fall_time(), but without branches, for neither the speed's sign nor the plane can be
/// foreseen.
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
