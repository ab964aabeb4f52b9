#include "engine/measure/estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clatter {

static constexpr std::size_t kMinBlocks = 32;

static double mean_of(std::span<const double> series) {
  if (series.empty()) return 0.0;
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

Estimate independent_estimate(std::span<const double> values) {
  const double mean = mean_of(values);
  const auto count = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (count * (count - 1.0)))};
}

// Standard errors of blocks of 1, 2, 4, ... values, calculated as if the blocks were independent.
static std::vector<double> error_levels(std::vector<double> series) {
  std::vector<double> errors;
  while (series.size() >= 2 && (errors.empty() || series.size() >= kMinBlocks)) {
    errors.push_back(independent_estimate(series).standard_error);
    for (std::size_t k = 0; k < series.size() / 2; ++k) {
      series[k] = 0.5 * (series[2 * k] + series[2 * k + 1]);
    }
    series.resize(series.size() / 2);
  }
  return errors;
}

static double largest(const std::vector<double>& errors) {
  return errors.empty() ? 0.0 : *std::ranges::max_element(errors);
}

static double rise_of(const std::vector<double>& errors) {
  if (errors.size() < 3) return 1.0;
  const double before = errors[errors.size() - 3];
  const double ratio = before > 0.0 ? errors.back() / before : 1.0;
  return std::max(1.0, ratio * ratio);
}

double blocked_error(std::vector<double> series) {
  return largest(error_levels(std::move(series)));
}

static double drift_of(double mean, const std::vector<double>& series) {
  constexpr double kRounding = 1e-9;  // relative to the mean; a smaller difference is rounding
  constexpr std::size_t kMinValues = 512;
  if (series.size() < kMinValues) return 0.0;
  const auto middle = series.begin() + static_cast<std::ptrdiff_t>(series.size() / 2);
  const auto half = [](auto begin, auto end) {
    const std::vector<double> values(begin, end);
    const std::vector<double> errors = error_levels(values);
    return Estimate{mean_of(values), largest(errors), rise_of(errors), 0.0};
  };
  const Estimate first = half(series.begin(), middle), second = half(middle, series.end());
  const double difference = second.mean - first.mean;
  if (std::fabs(difference) <= kRounding * std::fabs(mean)) return 0.0;
  return difference / std::hypot(first.cautious_error(), second.cautious_error());
}

Estimate linear_estimate(double mean, const std::vector<double>& contributions) {
  const std::vector<double> errors = error_levels(contributions);
  return {mean, largest(errors), rise_of(errors), drift_of(mean, contributions)};
}

Estimate mean_estimate(std::span<const double> series) {
  return linear_estimate(mean_of(series), {series.begin(), series.end()});
}

Estimate ratio_estimate(std::span<const double> numerator, std::span<const double> denominator) {
  const double below = mean_of(denominator);
  if (below == 0.0) return {};
  const double ratio = mean_of(numerator) / below;
  std::vector<double> deviations(numerator.size());
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    deviations[k] = (numerator[k] - ratio * denominator[k]) / below;
  }
  return linear_estimate(ratio, deviations);
}

}  // namespace clatter
