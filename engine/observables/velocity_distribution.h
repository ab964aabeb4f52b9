#pragma once

#include <cstdint>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Distribution of the velocities relative to the mean velocity, in units of the thermal speed
/// sqrt(T/m) of the same time (theory 11.4). Table "velocity_distribution" has a density for each
/// axis, and table "velocity_distribution.speed" that of the speed. The means
/// "velocity_distribution.a2" and ".a3" are the Sonine coefficients of the speed.
template <int D>
class VelocityDistribution final : public Observable {
 public:
  VelocityDistribution(const Simulation<D>& simulation, const DistributionSettings& settings)
      : simulation_(simulation), settings_(settings) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  const Simulation<D>& simulation_;
  DistributionSettings settings_;
};

extern template class VelocityDistribution<2>;
extern template class VelocityDistribution<3>;

}  // namespace clatter
