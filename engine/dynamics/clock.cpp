#include "engine/dynamics/clock.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "engine/physics/fraction.h"

namespace clatter {

// Error-free sum (Knuth's TwoSum): high + low is exactly a + b.
static LongTime two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

// Error-free product (Dekker's, with Veltkamp's splitting): high + low is exactly a * b.
static LongTime two_product(double a, double b) {
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

void Clock::advance(double shift) {
  const LongTime sum = two_sum(base_.high, shift);
  base_ = two_sum(sum.high, sum.low + base_.low);
}

double Clock::absolute(double relative) const {
  const LongTime sum = two_sum(base_.high, relative);
  return sum.high + (sum.low + base_.low);
}

double Clock::relative(double absolute) const {
  if (std::isinf(absolute)) return absolute;
  const LongTime difference = two_sum(absolute, -base_.high);
  return difference.high + (difference.low - base_.low);
}

double Clock::relative(double start, std::uint64_t count, double interval) const {
  // The splitting overflows beyond 1e300. No run reaches the end of so long an interval.
  constexpr double kLongest = 1e280;
  const LongTime product = two_product(static_cast<double>(count), std::min(interval, kLongest));
  const LongTime from_base = two_sum(start, -base_.high);
  const LongTime sum = two_sum(from_base.high, product.high);
  return sum.high + (sum.low + (from_base.low - base_.low + product.low));
}

double Clock::periods(double frequency, double phase) const {
  // First subtracts the nearest whole number of periods from each exact part; this is exact too.
  double sum = phase;
  for (const double part : {base_.high, base_.low}) {
    const LongTime product = two_product(frequency, part);
    sum += product.high - std::nearbyint(product.high);
    sum += product.low - std::nearbyint(product.low);
  }
  return fraction(sum);
}

}  // namespace clatter
