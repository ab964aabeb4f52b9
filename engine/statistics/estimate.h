#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace clatter {

/// A mean, its standard error, and two measures of their reliability.
struct Estimate {
  double mean = 0.0;
  double standard_error = 0.0;
  /// Ratio of the squared errors of the longest blocks and of blocks of a quarter of their length,
  /// at least 1. Far above 1 the error may rise further in a longer series.
  double rise = 1.0;
  /// Difference of the means of the series' second and first half, divided by their combined
  /// cautious errors. Beyond about 3 the series is not stationary. 0 for fewer than 512 values.
  double drift = 0.0;

  /// The standard error if its square rises once more by `rise`.
  double cautious_error() const { return standard_error * std::sqrt(rise); }
};

/// Mean of at least one independent value, and its standard error; NaN for a single value.
Estimate independent_estimate(std::span<const double> values);

/// Standard error of the mean of a correlated, stationary series from overlapping blocks (theory
/// 10.1-10.2; Meketon & Schmeiser 1984). The blocks have a sixteenth of the length of the series,
/// and the error is extrapolated to longer ones. Its relative uncertainty is about 20 %. Series of
/// fewer than 64 values have blocks of one value. 0 for fewer than two values.
double blocked_error(const std::vector<double>& series);

/// Mean of a series and its standard error as of blocked_error().
Estimate mean_estimate(std::span<const double> series);

/// Estimate of a function of means, with the value `mean`. `contributions` is the series of
/// linearised contributions of the values; it gives error, rise and drift.
Estimate linear_estimate(double mean, const std::vector<double>& contributions);

/// sum(numerator)/sum(denominator) and the standard error of the linearised ratio. Mean
/// 0 if the denominator is 0.
Estimate ratio_estimate(std::span<const double> numerator, std::span<const double> denominator);

}  // namespace clatter
