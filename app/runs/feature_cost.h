#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

// Prices are CPU time with something over that without it, as `clatter bench features` has it for
// 1000 disks at phi = 0.3.

/// Something that a scene may have the program model.
struct FeatureCost {
  const char* name;
  std::string extent;  ///< "no", "yes", or what of it
  double bytes;        ///< in all
  double price;        ///< NaN: it depends on what is not there
};

/// All that a scene may have, and what of it this one has.
std::vector<FeatureCost> feature_costs(const Scene& scene);

/// Of the averages of fields, by how disks count in them.
double cost_of(Estimator estimator);
/// Of balances.
inline constexpr double kBalanceCost = 2.0;
/// Of a contact time.
inline constexpr double kContactTimeCost = 1.0;

/// "x1.4", or "-" for NaN.
std::string cost_text(double price);

}  // namespace clatter
