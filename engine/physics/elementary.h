#pragma once

namespace clatter {

// Elementary functions with the same bits on every machine. Functions of C libraries differ in the
// last digit between libraries, and may differ between processors. The functions here use only + -
// * / and sqrt of doubles. A result without a stated error is within 1 ulp of the exact value.

/// Sine and cosine of one angle.
struct SineCosine {
  double sine;
  double cosine;
};

/// sin(2 pi phase) and cos(2 pi phase) for any finite phase, a number of turns; exactly 0, 1 or -1
/// at quarters of a turn.
SineCosine sin_cos_2pi(double phase);

/// sin(2 pi phase) for any finite phase.
inline double sin_2pi(double phase) {
  return sin_cos_2pi(phase).sine;
}

/// cos(2 pi phase) for any finite phase.
inline double cos_2pi(double phase) {
  return sin_cos_2pi(phase).cosine;
}

/// acos(x) / (2 pi) in turns, 0 to 1/2, for x in [-1,1].
double acos_turns(double x);

/// Natural logarithm of a finite x > 0, subnormal numbers included.
double natural_log(double x);

/// The value z below which a standard normal variable, cut at -3 and 3, is with a probability of
/// 0..1. The error is below 1e-12.
double cut_normal_quantile(double probability);

/// exp(x) for |x| <= 20 with a relative error below 1e-12.
double exponential(double x);

}  // namespace clatter
