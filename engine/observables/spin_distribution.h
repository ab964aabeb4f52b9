#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Distribution of the angular velocities in units of their root mean square at the same time
/// (theory 11.16), and of the angle between spin and velocity of a sphere (theory 11.17). Tables
/// "spin_distribution.components" and, for spheres, "spin_distribution.cosine". Means
/// "spin_distribution.kurtosis" and, for spheres, "..mean_squared_cosine".
template <int D>
class SpinDistribution final : public Observable {
 public:
  SpinDistribution(const Simulation<D>& simulation, const DistributionSettings& settings)
      : simulation_(simulation), settings_(settings) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  const Simulation<D>& simulation_;
  DistributionSettings settings_;
};

extern template class SpinDistribution<2>;
extern template class SpinDistribution<3>;

}  // namespace clatter
