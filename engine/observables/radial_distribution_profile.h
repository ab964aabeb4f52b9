#pragma once

#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/near_cells.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// g(r) of the particles in equal slabs along an axis, for example along the normal of a wall
/// (theory 11.20): the number of their pairs at distance r, relative to independent particles with
/// the densities of the slabs. Table "radial_distribution_profile".
template <int D>
class RadialDistributionProfile final : public Observable {
 public:
  RadialDistributionProfile(const Simulation<D>& simulation, const RadialProfileSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override { return 0; }
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  std::size_t slab_of(double coordinate) const;
  std::size_t apart(std::size_t slab, std::size_t other) const;
  double edge(std::size_t bin) const;
  double expected_share(std::size_t apart, double low, double high) const;
  double share_at(std::size_t apart, double distance) const;
  std::vector<double> expected_pairs(std::size_t slab, const ObservableParts& parts) const;

  const Simulation<D>& simulation_;
  int axis_;
  std::size_t slabs_;
  std::size_t bins_;
  bool periodic_;  // along the axis
  double begin_;   // of the first slab, along the axis
  double thickness_;
  double width_;  // of a bin
  NearCells<D> cells_;
  std::vector<double> shares_;          // [slabs apart][bins] see expected_share()
  std::vector<std::uint32_t> slab_of_;  // [N] in a sample
};

extern template class RadialDistributionProfile<2>;
extern template class RadialDistributionProfile<3>;

}  // namespace clatter
