#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace clatter {

/// A mean, its standard error, and how far both may be relied on.
struct Estimate {
  double mean = 0.0;
  double standard_error = 0.0;
  /// By how much the squared error has risen over the last two doublings of the blocks that it was
  /// found from, at least 1; what is far above 1 may rise further in a longer series.
  double rise = 1.0;
  /// The mean of the series' second half less that of the first, over their combined standard
  /// error, each enlarged by its rise: beyond some 3 the series is not stationary. 0 where there
  /// are fewer than 512 values.
  double drift = 0.0;

  /// The standard error if the squared one rises once more as it did.
  double cautious_error() const { return standard_error * std::sqrt(rise); }
};

/// Mean of independent values, at least one, and its standard error, NaN of a single one.
Estimate independent_estimate(std::span<const double> values);

/// Standard error of the mean of a correlated, stationary series by blocking (Flyvbjerg & Petersen
/// 1989): neighbours are averaged in pairs again and again, and the error that independent blocks
/// would have rises to that of the mean. The largest over the levels with at least 32 blocks is
/// taken, so the relative uncertainty of the error is at most 1/sqrt(62) = 13 %. 0 for fewer than
/// two values.
double blocked_error(std::vector<double> series);

/// Mean of a series and its standard error by blocking.
Estimate mean_estimate(std::span<const double> series);

/// A function of means, `mean`, whose error and course are those of a series of contributions: what
/// each value of the means adds to it, linearised.
Estimate linear_estimate(double mean, const std::vector<double>& contributions);

/// sum(numerator)/sum(denominator) and its standard error by blocking of the linearised ratio; mean
/// 0 where the denominator is.
Estimate ratio_estimate(std::span<const double> numerator, std::span<const double> denominator);

}  // namespace clatter
