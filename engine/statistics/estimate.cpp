#include "engine/statistics/estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clatter {

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

namespace {

// The squared standard error that all blocks of `length` neighbours give (theory 10.1). `sums` are
// the partial sums of the deviations from the mean.
double squared_error(const std::vector<double>& sums, std::size_t length) {
  const std::size_t blocks = sums.size() - length;
  double squares = 0.0;
  for (std::size_t k = 0; k < blocks; ++k) {
    const double sum = sums[k + length] - sums[k];
    squares += sum * sum;
  }
  return squares / static_cast<double>(length) / static_cast<double>(blocks) /
         static_cast<double>(blocks - 1);
}

struct BlockError {
  double error = 0.0;
  double rise = 1.0;
};

// A quarter of the blocks has a whole number of values.
BlockError block_error(std::span<const double> series) {
  constexpr std::size_t kBlocks = 16;
  if (series.size() < 2) return {};
  const double mean = mean_of(series);
  std::vector<double> sums(series.size() + 1);
  for (std::size_t k = 0; k < series.size(); ++k) sums[k + 1] = sums[k] + (series[k] - mean);
  const std::size_t quarter = series.size() / (4 * kBlocks);
  if (quarter == 0) return {std::sqrt(squared_error(sums, 1)), 1.0};
  const double whole = squared_error(sums, 4 * quarter);
  const double half = squared_error(sums, 2 * quarter);
  const double before = squared_error(sums, quarter);
  // (theory 10.2)
  return {std::sqrt(std::max(whole, 2.0 * whole - half)),
          before > 0.0 ? std::max(1.0, whole / before) : 1.0};
}

}  // namespace

double blocked_error(const std::vector<double>& series) {
  return block_error(series).error;
}

static double drift_of(double mean, const std::vector<double>& series) {
  constexpr double kRounding = 1e-9;  // relative to the mean; a smaller difference is rounding
  constexpr std::size_t kMinValues = 512;
  if (series.size() < kMinValues) return 0.0;
  const auto half = [](std::span<const double> values) {
    const BlockError block = block_error(values);
    return Estimate{mean_of(values), block.error, block.rise, 0.0};
  };
  const std::span<const double> values = series;
  const Estimate first = half(values.first(values.size() / 2));
  const Estimate second = half(values.subspan(values.size() / 2));
  const double difference = second.mean - first.mean;
  if (std::fabs(difference) <= kRounding * std::fabs(mean)) return 0.0;
  return difference / std::hypot(first.cautious_error(), second.cautious_error());
}

Estimate linear_estimate(double mean, const std::vector<double>& contributions) {
  const BlockError block = block_error(contributions);
  return {mean, block.error, block.rise, drift_of(mean, contributions)};
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
