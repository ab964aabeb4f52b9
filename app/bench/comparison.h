#pragma once

#include <array>
#include <vector>

#include "app/bench/run_result.h"
#include "engine/measure/estimate.h"

namespace clatter {

/// Means first, in their order, then the profile of the density, in the mean of squares over it.
inline constexpr int kCompared = kComparedMeans + 1;
inline constexpr int kDensityProfile = kComparedMeans;

/// How far a setting's replicas are from those of a reference, as shares of the reference.
struct Comparison {
  /// [kCompared] differences with standard errors; of the density, the root of the mean square
  /// difference less what scatter contributes. NaN: the reference has none.
  std::array<Estimate, kCompared> bias;
  /// sqrt(bias^2 + variance per CPU second), the root mean square of it over all that is compared:
  /// the error of means that take one second of CPU. bias^2 is less the square of its standard
  /// error, at least 0.
  double error = 0.0;
};

/// Compares replicas, of which those of the same place in both lists have the same seed: their
/// differences are averaged, so that what both have in common does not count as scatter.
Comparison compare(const std::vector<RunResult>& replicas, const std::vector<RunResult>& reference);

/// A mean of a reference's replicas; the heat flux with the sign that it has in each column.
Estimate mean_over(const std::vector<RunResult>& replicas, ComparedMean quantity,
                   const std::vector<RunResult>& reference);

/// The intercept at 0 of the straight line through estimates at `places`, each weighted by its
/// error; the points have the same mean square distance from it as their errors say.
Estimate extrapolate(const std::vector<double>& places, const std::vector<Estimate>& estimates);

}  // namespace clatter
