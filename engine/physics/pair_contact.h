#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace clatter {

inline constexpr double kNever = std::numeric_limits<double>::infinity();
/// Replaces the contact time of particles that already touch; their contact depends on rounding.
inline constexpr double kTouching = -std::numeric_limits<double>::infinity();

/// The square root of a number, or of each component of a vector.
template <class Number>
[[gnu::always_inline]] inline Number root_of(const Number& x) {
  if constexpr (std::is_same_v<Number, double>) {
    return std::sqrt(x);
  } else {
    double roots[sizeof(Number) / sizeof(double)];
    std::memcpy(roots, &x, sizeof x);
    for (double& root : roots) root = std::sqrt(root);
    Number result;
    std::memcpy(&result, roots, sizeof result);
    return result;
  }
}

/// Sum of the products of two vectors' components.
template <int D, class Number>
[[gnu::always_inline]] inline Number dot(const Number* a, const Number* b) {
  Number sum = a[0] * b[0];
  for (int k = 1; k < D; ++k) sum += a[k] * b[k];
  return sum;
}

/// Approach of two particles, which determines their contact time, see pair_contact_time. Number is
/// double, or a vector of doubles with one pair per component.
template <class Number>
struct PairApproach {
  Number start;         ///< of the later flight
  Number gap;           ///< |x|^2 - s^2 at the start, where s is the distance at contact
  Number rate;          ///< x.g
  Number discriminant;  ///< g^2 s^2 - |x ^ g|^2
};

/// The approach of two flights. `distance` is that of the centres at contact: a Number, or a double
/// for all pairs. A null `shift` means 0. Without kFalling, `gravity` is not read. `slide` is the
/// velocity of the shift along x in a sheared box, where `shift` is that at time 0; null: 0.
///
/// Gravity accelerates all particles equally, so relative motion is along a straight line. Gravity
/// enters only through the positions and velocities at the later flight's start.
template <int D, bool kFalling, class Number, class Distance>
[[gnu::always_inline]] inline PairApproach<Number> approach_of(
    const Number* r_a, const Number* v_a, const Number& time_a, const Number* r_b,
    const Number* v_b, const Number& time_b, const Number* shift, const Distance& distance,
    const double* gravity, const Number* slide = nullptr) {
  const Number start = time_a > time_b ? time_a : time_b;
  const Number since_a = start - time_a, since_b = start - time_b;
  Number x[D], g[D];
  for (int k = 0; k < D; ++k) {
    if constexpr (kFalling) {
      x[k] = (r_a[k] + (v_a[k] + gravity[k] * (0.5 * since_a)) * since_a) -
             (r_b[k] + (v_b[k] + gravity[k] * (0.5 * since_b)) * since_b);
      g[k] = (v_a[k] + gravity[k] * since_a) - (v_b[k] + gravity[k] * since_b);
    } else {
      x[k] = (r_a[k] + v_a[k] * since_a) - (r_b[k] + v_b[k] * since_b);
      g[k] = v_a[k] - v_b[k];
    }
    if (shift) x[k] += shift[k];
  }
  if (slide) {
    x[0] += *slide * start;
    g[0] += *slide;
  }
  Number wedge_squared{};
  for (int k = 0; k < D; ++k) {
    for (int l = k + 1; l < D; ++l) {
      const Number area = x[k] * g[l] - x[l] * g[k];
      // The first term is assigned: a compiler may not omit an addition to zero.
      wedge_squared = k == 0 && l == 1 ? area * area : wedge_squared + area * area;
    }
  }
  return {start, dot<D>(x, x) - distance * distance, dot<D>(x, g),
          dot<D>(g, g) * (distance * distance) - wedge_squared};
}

/// Time at which the particles of two flights touch, kNever, or kTouching. Exchange of the flights
/// with a negated shift gives the same bits. So the result does not depend on the particle and the
/// time of the prediction.
///
/// Contact is the first root of |x + g t| = s. Its discriminant is calculated as g^2 s^2 - |x ^
/// g|^2. Unlike (x.g)^2 - g^2 (x^2 - s^2), this form has no cancellation for particles that start
/// far apart.
template <class Number>
[[gnu::always_inline]] inline Number pair_contact_time(const PairApproach<Number>& a) {
  const Number zero{};
  const Number root = root_of<Number>(a.discriminant > zero ? a.discriminant : zero);
  const Number time = a.gap > zero ? a.start + a.gap / (root - a.rate) : zero + kTouching;
  const Number met = a.discriminant > zero ? time : zero + kNever;
  return a.rate < zero ? met : zero + kNever;
}

/// pair_contact_time of the approach_of two flights.
template <int D, bool kFalling, class Number>
[[gnu::always_inline]] inline Number pair_contact_time(const Number* r_a, const Number* v_a,
                                                       const Number& time_a, const Number* r_b,
                                                       const Number* v_b, const Number& time_b,
                                                       const Number* shift, double distance,
                                                       const double* gravity,
                                                       const Number* slide = nullptr) {
  return pair_contact_time(approach_of<D, kFalling>(r_a, v_a, time_a, r_b, v_b, time_b, shift,
                                                    distance, gravity, slide));
}

}  // namespace clatter
