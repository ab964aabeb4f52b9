#pragma once

// No Eigen here: kernels for wider instruction sets include this file, and Eigen's layouts depend
// on the instruction set.

#include <cmath>
#include <limits>

namespace clatter {

inline constexpr double kNever = std::numeric_limits<double>::infinity();
/// Stands for the contact time of disks that touch already; what they do depends on rounding.
inline constexpr double kTouching = -std::numeric_limits<double>::infinity();

/// Time at which the disks of two flights touch, kNever, or kTouching. Exchanging the flights and
/// negating the shift gives the same bits, so it does not matter who asks or when.
///
/// Disks share the acceleration of gravity, so seen from each other they move on straight lines; it
/// enters only where they are at the later flight's start. Without kFalling, `gravity` is not read.
///
/// Contact is the first root of |x + g t| = a. Its discriminant is taken as g^2 a^2 - |x ^ g|^2,
/// which unlike (x.g)^2 - g^2 (x^2 - a^2) loses nothing when the disks start far apart.
template <int D, bool kFalling>
[[gnu::always_inline]] inline double encounter_time(const double* r_a, const double* v_a,
                                                    double time_a, const double* r_b,
                                                    const double* v_b, double time_b,
                                                    const double* shift, double diameter,
                                                    const double* gravity) {
  const double start = time_a > time_b ? time_a : time_b;
  const double since_a = start - time_a, since_b = start - time_b;
  double x[D], g[D];
  double approach = 0.0, distance_squared = 0.0, speed_squared = 0.0, wedge_squared = 0.0;
  for (int k = 0; k < D; ++k) {
    if constexpr (kFalling) {
      x[k] = ((r_a[k] + (v_a[k] + gravity[k] * (0.5 * since_a)) * since_a) -
              (r_b[k] + (v_b[k] + gravity[k] * (0.5 * since_b)) * since_b)) +
             shift[k];
      g[k] = (v_a[k] + gravity[k] * since_a) - (v_b[k] + gravity[k] * since_b);
    } else {
      x[k] = ((r_a[k] + v_a[k] * since_a) - (r_b[k] + v_b[k] * since_b)) + shift[k];
      g[k] = v_a[k] - v_b[k];
    }
    approach += x[k] * g[k];
    distance_squared += x[k] * x[k];
    speed_squared += g[k] * g[k];
  }
  for (int k = 0; k < D; ++k) {
    for (int l = k + 1; l < D; ++l) {
      const double area = x[k] * g[l] - x[l] * g[k];
      wedge_squared += area * area;
    }
  }
  const double gap = distance_squared - diameter * diameter;
  const double discriminant = speed_squared * (diameter * diameter) - wedge_squared;
  const double root = std::sqrt(discriminant > 0.0 ? discriminant : 0.0);
  const double time = gap > 0.0 ? start + gap / (root - approach) : kTouching;
  return approach < 0.0 && discriminant > 0.0 ? time : kNever;
}

}  // namespace clatter
