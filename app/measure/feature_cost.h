#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

// A price is a ratio of CPU times, with and without the feature. The values are from `clatter bench
// features` with 1000 disks at phi = 0.3.

/// An optional feature of a scene.
struct FeatureCost {
  const char* name;
  std::string extent;  ///< "no", "yes", or the used part of the feature
  double bytes;        ///< total
  double price;        ///< NaN: depends on an absent feature
};

/// All optional features, with their use in this scene.
std::vector<FeatureCost> feature_costs(const Scene& scene);

/// Memory of a scene in bytes: the sum of its features.
double memory_of(const Scene& scene);

/// Throws UserError if a scene needs more than available_memory().
void require_room(const Scene& scene);

/// Price of field averages, by estimator.
double cost_of(Estimator estimator);
/// Price of balances.
inline constexpr double kBalanceCost = 2.0;
/// Price of a contact time.
inline constexpr double kContactTimeCost = 1.0;

/// "x1.4", or "-" for NaN.
std::string cost_text(double price);

}  // namespace clatter
