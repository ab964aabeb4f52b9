#pragma once

#include <cmath>

namespace clatter {

/// x without its whole part, in [0,1) for negative x too: a phase in periods.
inline double fraction(double x) {
  const double part = x - std::floor(x);
  return part < 1.0 ? part : 0.0;  // A tiny x below zero rounds to 1.
}

}  // namespace clatter
