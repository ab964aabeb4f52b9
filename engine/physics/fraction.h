#pragma once

#include <cmath>

namespace clatter {

/// Fractional part of x, in [0,1) also for negative x: a phase in periods.
inline double fraction(double x) {
  const double part = x - std::floor(x);
  return part < 1.0 ? part : 0.0;  // A tiny x below zero rounds to 1.
}

}  // namespace clatter
