#include "engine/dynamics/clock.h"

#include <cmath>
#include <initializer_list>

#include "engine/physics/fraction.h"

namespace clatter {

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

double Clock::relative(const LongTime& absolute) const {
  const LongTime difference = two_sum(absolute.high, -base_.high);
  return difference.high + (difference.low + (absolute.low - base_.low));
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
