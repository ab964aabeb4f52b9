#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/observables/region.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Distribution of the velocities in the box or in a region, relative to their mean, in units of
/// the thermal speed sqrt(T/m) of the same particles and time (theory 11.4). Table
/// "velocity_distribution" has a density for each axis, "velocity_distribution.tails" the same in
/// logarithmic bins, and "velocity_distribution.speed" that of the speed. The means
/// "velocity_distribution.a2" and ".a3" are the Sonine coefficients of the speed,
/// ".second_moment_x", ".third_moment_x", ".fourth_moment_x" and so on moments of the components.
/// In a mixture m is the mass of each particle, and T that of all; each species that
/// has particles has its densities,
/// ".temperature_ratio_large" T_s/T and ".a2_large" its Sonine coefficient.
template <int D>
class VelocityDistribution final : public Observable {
 public:
  VelocityDistribution(const Simulation<D>& simulation,
                       const VelocityDistributionSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  void find_velocities();
  void note(const Grain& grain);
  std::vector<std::size_t> species_present() const;
  double centre();
  void add_species(ResultTable& table, std::size_t species, const ObservableParts& parts) const;
  Estimate species_a2(std::size_t species, const ObservableParts& parts) const;
  ResultTable components(const ObservableParts& parts) const;

  const Simulation<D>& simulation_;
  double range_;
  std::size_t bins_;
  std::size_t species_;              // number of species of a mixture; 0: particles are alike
  std::optional<Region<D>> region_;  // absent: the box
  std::vector<Vec<D>> velocities_;   // of a sample
  std::vector<double> masses_;       // of its particles; empty: they are alike
  std::vector<std::uint32_t> species_of_;
};

extern template class VelocityDistribution<2>;
extern template class VelocityDistribution<3>;

}  // namespace clatter
