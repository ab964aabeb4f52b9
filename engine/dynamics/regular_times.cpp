#include "engine/dynamics/regular_times.h"

#include <algorithm>
#include <cmath>

namespace clatter {

// The smallest power of ten whose product with a number is whole, so that the number is the double
// next to their quotient. 0: none.
static double decimals_of(double number) {
  constexpr double kMost = 1e15;
  for (double power = 1.0; power <= kMost; power *= 10.0) {
    if (std::round(number * power) / power == number) return power;
  }
  return 0.0;
}

// Products beyond 1e300 are not exact. No run reaches the end of so long an interval.
RegularTimes::RegularTimes(double start, double interval)
    : start_(start), interval_(std::min(interval, 1e280)), decimals_(decimals_of(interval_)) {}

LongTime RegularTimes::exactly(std::uint64_t number) const {
  const double parts = decimals_ > 1.0 ? std::round(interval_ * decimals_) : interval_;
  LongTime span = two_product(static_cast<double>(number), parts);
  if (decimals_ > 1.0) {
    const double quotient = span.high / decimals_;
    const LongTime covered = two_product(quotient, decimals_);
    span = two_sum(quotient, ((span.high - covered.high) - covered.low + span.low) / decimals_);
  }
  const LongTime sum = two_sum(start_, span.high);
  return two_sum(sum.high, sum.low + span.low);
}

std::uint64_t RegularTimes::first_from(double time) const {
  auto number = static_cast<std::uint64_t>(std::max(0.0, std::floor((time - start_) / interval_)));
  while (of(number) < time) ++number;
  return number;
}

}  // namespace clatter
