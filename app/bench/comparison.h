#pragma once

#include <array>
#include <span>
#include <vector>

#include "app/bench/run_result.h"
#include "engine/statistics/estimate.h"

namespace clatter {

/// The means in their order, then the root mean square of the density profile.
inline constexpr int kCompared = kComparedMeans + 1;
inline constexpr int kDensityProfile = kComparedMeans;

/// Deviation of a setting from a reference, relative to the reference.
struct Comparison {
  /// [kCompared] relative differences with standard errors. For the density: the root mean square
  /// difference minus the contribution of the scatter. NaN: the reference has no value.
  std::array<Estimate, kCompared> bias;
  /// sqrt(bias^2 + variance per CPU second), the root mean square over all compared quantities: the
  /// error of means from one CPU second. The squared standard error is subtracted from bias^2, down
  /// to 0.
  double error = 0.0;
};

/// Compares replicas with a reference. Replicas with the same index have the same seed. The average
/// of their differences excludes their common scatter.
Comparison compare(const std::vector<RunResult>& replicas, const std::vector<RunResult>& reference);

/// A mean over the replicas of a reference. The heat flux has its sign of each column.
Estimate mean_over(const std::vector<RunResult>& replicas, ComparedMean quantity,
                   const std::vector<RunResult>& reference);

/// The intercept at 0 of a linear fit through estimates at `places`, weighted by their errors.
Estimate extrapolate(const std::vector<double>& places, const std::vector<Estimate>& estimates);

/// Compares the extrapolation of settings to value 0 with a reference. `values` has the value of
/// each setting. Density and error: NaN.
Comparison compare_limit(const std::vector<double>& values,
                         std::span<const std::vector<RunResult>> settings,
                         const std::vector<RunResult>& reference);

}  // namespace clatter
