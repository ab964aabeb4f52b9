#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace clatter::testing {

/// Pearson's chi^2 of observed against expected counts, as its distance from the mean k of the
/// chi^2 distribution of k = bins - 1 degrees of freedom in standard deviations sqrt(2 k). With
/// fixed seeds a test that asks for |excess| < 5 fails by chance about once in 10^6 choices of
/// seed.
inline double chi_squared_excess(std::span<const double> observed,
                                 std::span<const double> expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const double miss = observed[i] - expected[i];
    sum += miss * miss / expected[i];
  }
  const double freedom = static_cast<double>(observed.size()) - 1.0;
  return (sum - freedom) / std::sqrt(2.0 * freedom);
}

/// Mean of a sample, as its distance from the mean expected in standard errors.
inline double standard_errors_off(double sum, double samples, double mean, double variance) {
  return (sum / samples - mean) / std::sqrt(variance / samples);
}

}  // namespace clatter::testing
