#include "engine/physics/quantile.h"

#include <cmath>
#include <numbers>

namespace clatter {

// P(0 < Z < z) of a standard normal variable for 0 <= z <= 3, by its power series.
static double normal_share(double z) {
  const double half = 0.5 * z * z;
  double term = z, sum = z;  // (-1)^k z (z^2/2)^k / k!, and its sum over 2k + 1
  for (int k = 1; std::fabs(term) > 1e-18; ++k) {
    term *= -half / k;
    sum += term / (2 * k + 1);
  }
  return sum * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

double cut_normal_quantile(double probability) {
  static const double kShare = normal_share(3.0);
  const double share = 2.0 * std::fabs(probability - 0.5) * kShare;
  // The share is concave, so Newton's method increases towards the solution.
  double z = 0.0;
  for (double before = -1.0; z > before && z < 3.0;) {
    before = z;
    const double density =
        exponential(-0.5 * z * z) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    z += (share - normal_share(z)) / density;
  }
  z = std::fmin(z, 3.0);
  return probability < 0.5 ? -z : z;
}

double exponential(double x) {
  constexpr int kHalvings = 10;
  const double r = x / (1 << kHalvings);
  double power = 0.0;  // exp(r) - 1, by its power series
  for (int k = 9; k > 0; --k) power = (1.0 + power) * r / k;
  for (int k = 0; k < kHalvings; ++k) power *= 2.0 + power;
  return 1.0 + power;
}

}  // namespace clatter
