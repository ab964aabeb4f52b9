#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace clatter {

/// A mean, its standard error, and two measures of their reliability.
struct Estimate {
  double mean = 0.0;
  double standard_error = 0.0;
  /// Ratio of the squared errors over the last two doublings of the block length, at least 1. Far
  /// above 1 the error may rise further in a longer series.
  double rise = 1.0;
  /// Difference of the means of the series' second and first half, divided by their combined
  /// cautious errors. Beyond about 3 the series is not stationary. 0 for fewer than 512 values.
  double drift = 0.0;

  /// The standard error if its square rises once more by `rise`.
  double cautious_error() const { return standard_error * std::sqrt(rise); }
};

/// Mean of at least one independent value, and its standard error; NaN for a single value.
Estimate independent_estimate(std::span<const double> values);

/// Standard error of the mean of a correlated, stationary series by blocking (Flyvbjerg & Petersen
/// 1989): neighbours are averaged in pairs repeatedly, and the error of blocks, as if independent,
/// rises to the error of the mean. The result is the largest error over the levels with at least 32
/// blocks, so its relative uncertainty is at most 1/sqrt(62) = 13 %. 0 for fewer than two values.
double blocked_error(std::vector<double> series);

/// Mean of a series and its standard error by blocking.
Estimate mean_estimate(std::span<const double> series);

/// Estimate of a function of means, with the value `mean`. `contributions` is the series of
/// linearised contributions of the values; it gives error, rise and drift.
Estimate linear_estimate(double mean, const std::vector<double>& contributions);

/// sum(numerator)/sum(denominator) and its standard error by blocking of the linearised ratio. Mean
/// 0 if the denominator is 0.
Estimate ratio_estimate(std::span<const double> numerator, std::span<const double> denominator);

}  // namespace clatter
