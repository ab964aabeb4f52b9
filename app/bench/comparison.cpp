#include "app/bench/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter {

namespace {

using Replicas = std::vector<RunResult>;

ProfileValues mean_profile(const Replicas& replicas, ProfileValues RunResult::*profile) {
  ProfileValues mean{};
  for (const RunResult& replica : replicas) {
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k] += (replica.*profile)[k] / static_cast<double>(replicas.size());
    }
  }
  return mean;
}

// Replicas are independent. Blocking would waste data.
Estimate independent_mean(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, count > 1.0 ? std::sqrt(squares / (count * (count - 1.0))) : 0.0};
}

// One mean per replica.
std::vector<double> values_of(const Replicas& replicas, ComparedMean quantity,
                              const ProfileValues& heat_flux) {
  std::vector<double> values;
  for (const RunResult& replica : replicas) {
    double value = replica.means[quantity];
    if (quantity == kHeatFlux) {
      value = 0.0;
      for (std::size_t k = 0; k < heat_flux.size(); ++k) {
        value += heat_flux[k] < 0.0 ? -replica.heat_flux[k] : replica.heat_flux[k];
      }
      value /= kProfileColumns;
    }
    values.push_back(value);
  }
  return values;
}

// The square of a mean over replicas, without the contribution of their scatter, summed over
// columns. `skipped` leaves out one replica.
double square_of_mean(const std::vector<ProfileValues>& replicas, std::size_t skipped) {
  double sum = 0.0;
  const auto count = static_cast<double>(replicas.size() - (skipped < replicas.size() ? 1 : 0));
  for (std::size_t k = 0; k < kProfileColumns; ++k) {
    double total = 0.0, squares = 0.0;
    for (std::size_t r = 0; r < replicas.size(); ++r) {
      if (r == skipped) continue;
      total += replicas[r][k];
      squares += replicas[r][k] * replicas[r][k];
    }
    sum += (total * total - squares) / (count * (count - 1.0));
  }
  return sum;
}

// The root mean square of a profile of differences. The jackknife over replicas gives the error.
Estimate profile_bias(const std::vector<ProfileValues>& differences) {
  const std::size_t count = differences.size();
  const double square = square_of_mean(differences, count) / kProfileColumns;
  std::vector<double> without;
  for (std::size_t r = 0; r < count && count > 2; ++r) {
    without.push_back(square_of_mean(differences, r) / kProfileColumns);
  }
  const double error = static_cast<double>(count - 1) * independent_mean(without).standard_error;
  const double root = std::sqrt(std::max(0.0, square));
  return {root, root * root > error ? 0.5 * error / root : std::sqrt(error)};
}

struct ProfileComparison {
  Estimate bias;
  double variance = 0.0;  // of the mean profile of the setting, averaged over columns
};

ProfileComparison compare_densities(const Replicas& replicas, const Replicas& reference) {
  const ProfileValues mean = mean_profile(reference, &RunResult::density);
  double scale = 0.0;
  for (const double value : mean) scale += value / kProfileColumns;
  std::vector<ProfileValues> differences(replicas.size());
  ProfileComparison comparison;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    std::vector<double> column;
    for (std::size_t r = 0; r < replicas.size(); ++r) {
      column.push_back(replicas[r].density[k] / scale);
      differences[r][k] = column.back() - reference[r].density[k] / scale;
    }
    const double error = independent_mean(column).standard_error;
    comparison.variance += error * error / kProfileColumns;
  }
  comparison.bias = profile_bias(differences);
  return comparison;
}

double cpu_of(const Replicas& replicas) {
  double seconds = 0.0;
  for (const RunResult& replica : replicas) seconds += replica.cpu_seconds;
  return seconds;
}

}  // namespace

Estimate mean_over(const Replicas& replicas, ComparedMean quantity, const Replicas& reference) {
  return independent_mean(
      values_of(replicas, quantity, mean_profile(reference, &RunResult::heat_flux)));
}

Comparison compare(const Replicas& replicas, const Replicas& reference) {
  const ProfileValues heat_flux = mean_profile(reference, &RunResult::heat_flux);
  const double cpu = cpu_of(replicas);
  Comparison comparison;
  double squares = 0.0;
  int compared = 0;
  const auto add = [&](int k, const Estimate& bias, double variance) {
    comparison.bias[k] = bias;
    if (std::isnan(bias.mean)) return;
    const double error = bias.standard_error;
    squares += std::max(0.0, bias.mean * bias.mean - error * error) + variance * cpu;
    ++compared;
  };
  for (int k = 0; k < kComparedMeans; ++k) {
    const auto quantity = static_cast<ComparedMean>(k);
    std::vector<double> values = values_of(replicas, quantity, heat_flux);
    const std::vector<double> others = values_of(reference, quantity, heat_flux);
    const double mean = independent_mean(others).mean;
    // A difference relative to 0 is undefined, for example in the dissipation of elastic disks.
    const double scale = mean == 0.0 ? kNotANumber : mean;
    const double error = independent_mean(values).standard_error / scale;
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = (values[r] - others[r]) / scale;
    add(k, independent_mean(values), error * error);
  }
  const ProfileComparison density = compare_densities(replicas, reference);
  add(kDensityProfile, density.bias, density.variance);
  comparison.error = std::sqrt(squares / std::max(1, compared));
  return comparison;
}

Estimate extrapolate(const std::vector<double>& places, const std::vector<Estimate>& estimates) {
  double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double error = estimates[k].standard_error, w = 1.0 / (error * error);
    weight += w;
    x += w * places[k];
    y += w * estimates[k].mean;
    xx += w * places[k] * places[k];
    xy += w * places[k] * estimates[k].mean;
  }
  const double determinant = weight * xx - x * x;
  return {(xx * y - x * xy) / determinant, std::sqrt(xx / determinant)};
}

Comparison compare_limit(const std::vector<double>& values, std::span<const Replicas> settings,
                         const Replicas& reference) {
  Comparison comparison;
  for (int k = 0; k < kComparedMeans; ++k) {
    const auto quantity = static_cast<ComparedMean>(k);
    std::vector<Estimate> estimates;
    for (const Replicas& replicas : settings) {
      estimates.push_back(mean_over(replicas, quantity, reference));
    }
    const Estimate exact = mean_over(reference, quantity, reference);
    const Estimate limit = extrapolate(values, estimates);
    comparison.bias[k] = {
        limit.mean / exact.mean - 1.0,
        std::hypot(limit.standard_error, exact.standard_error) / std::fabs(exact.mean)};
  }
  comparison.bias[kDensityProfile] = {kNotANumber, kNotANumber};
  comparison.error = kNotANumber;
  return comparison;
}

}  // namespace clatter
