#include "app/runs/regular_times.h"

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

RegularTimes::RegularTimes(double every) : every_(every), decimals_(decimals_of(every)) {}

double RegularTimes::of(long number) const {
  const auto count = static_cast<double>(number);
  if (decimals_ == 0.0) return count * every_;
  return count * std::round(every_ * decimals_) / decimals_;
}

long RegularTimes::first_from(double time) const {
  auto number = static_cast<long>(std::floor(time / every_));
  while (of(number) < time) ++number;
  return number;
}

}  // namespace clatter
