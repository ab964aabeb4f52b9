#pragma once

namespace clatter {

/// A simulation time as an unevaluated sum of two doubles, about 32 digits.
struct LongTime {
  double high = 0.0;
  double low = 0.0;
};

/// Error-free sum (Knuth's TwoSum): high + low is exactly a + b.
inline LongTime two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

/// Error-free product (Dekker's, with Veltkamp's splitting) of numbers up to 1e300: high + low is
/// exactly a * b.
inline LongTime two_product(double a, double b) {
  const auto split = [](double x) {
    const double c = 134217729.0 * x;  // 2^27 + 1
    const double high = c - (c - x);
    return LongTime{high, x - high};
  };
  const LongTime x = split(a);
  const LongTime y = split(b);
  const double high = a * b;
  return {high, ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

}  // namespace clatter
