#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace clatter::testing {

/// Probability of at least this chi^2 with `freedom` degrees of freedom, by the approximation of
/// Wilson & Hilferty 1931: its cube root is nearly normal. Accurate to a few percent of p for p >
/// 1e-4 and freedom >= 5.
inline double chi_squared_p(double chi_squared, double freedom) {
  const double width = 2.0 / (9.0 * freedom);
  const double z = (std::cbrt(chi_squared / freedom) - (1.0 - width)) / std::sqrt(width);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// The same for counts and their expected values. The total is fixed, which removes one degree of
/// freedom.
inline double counts_p(std::span<const double> observed, std::span<const double> expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const double miss = observed[i] - expected[i];
    sum += miss * miss / expected[i];
  }
  return chi_squared_p(sum, static_cast<double>(observed.size()) - 1.0);
}

/// A statistical test of many numbers fails below this probability.
inline constexpr double kMinProbability = 1e-3;

/// Distance of a sample mean from its expected value, in standard errors.
inline double standard_errors_off(double sum, double samples, double mean, double variance) {
  return (sum / samples - mean) / std::sqrt(variance / samples);
}

/// Independent values, for example one per seed: their mean and its standard error.
struct Sample {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;

  void add(double value) {
    count += 1.0;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / count; }
  double standard_error() const {
    return std::sqrt((squares / count - mean() * mean()) / (count - 1.0));
  }
};

}  // namespace clatter::testing
