#include "engine/measure/estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clatter {

static double mean_of(std::span<const double> series) {
  if (series.empty()) return 0.0;
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

double blocked_error(std::vector<double> series) {
  constexpr std::size_t kLeastBlocks = 32;
  double largest = 0.0;
  for (bool first = true; series.size() >= 2 && (first || series.size() >= kLeastBlocks);
       first = false) {
    const double mean = mean_of(series);
    const double blocks = static_cast<double>(series.size());
    double squares = 0.0;
    for (const double value : series) squares += (value - mean) * (value - mean);
    largest = std::max(largest, std::sqrt(squares / (blocks * (blocks - 1.0))));
    for (std::size_t k = 0; k < series.size() / 2; ++k) {
      series[k] = 0.5 * (series[2 * k] + series[2 * k + 1]);
    }
    series.resize(series.size() / 2);
  }
  return largest;
}

Estimate mean_estimate(std::span<const double> series) {
  return {mean_of(series), blocked_error({series.begin(), series.end()})};
}

Estimate ratio_estimate(std::span<const double> numerator, std::span<const double> denominator) {
  const double below = mean_of(denominator);
  if (below == 0.0) return {};
  const double ratio = mean_of(numerator) / below;
  std::vector<double> deviations(numerator.size());
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    deviations[k] = (numerator[k] - ratio * denominator[k]) / below;
  }
  return {ratio, blocked_error(std::move(deviations))};
}

}  // namespace clatter
