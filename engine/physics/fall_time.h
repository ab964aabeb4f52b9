#pragma once

#include <cmath>

#include "engine/physics/encounter.h"

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

}  // namespace clatter
