#pragma once

#include <span>
#include <vector>

namespace clatter {

/// A mean and its standard error.
struct Estimate {
  double mean = 0.0;
  double standard_error = 0.0;
};

/// Standard error of the mean of a correlated, stationary series by blocking (Flyvbjerg & Petersen
/// 1989): neighbours are averaged in pairs again and again, and the error that independent blocks
/// would have rises to that of the mean. The largest over the levels with at least 32 blocks is
/// taken, so the relative uncertainty of the error is at most 1/sqrt(62) = 13 %. 0 for fewer than
/// two values.
double blocked_error(std::vector<double> series);

/// Mean of a series and its standard error by blocking.
Estimate mean_estimate(std::span<const double> series);

/// sum(numerator)/sum(denominator) and its standard error by blocking of the linearised ratio; mean
/// 0 where the denominator is.
Estimate ratio_estimate(std::span<const double> numerator, std::span<const double> denominator);

}  // namespace clatter
