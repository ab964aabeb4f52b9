#pragma once

#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/near_cells.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// g(r) of all pairs of a mixture in a periodic box, and g_st(r) of the pairs of each two species
/// (theory 11.6, 12.16). Bins begin at the smallest diameter. Table "radial_distribution" has a
/// column "g_small+large" for each two species. The means "radial_distribution.contact_small+large"
/// are the values at contact, extrapolated from distances near it. A pair has none if these
/// distances go beyond the range.
template <int D>
class SpeciesRadialDistribution final : public Observable {
 public:
  SpeciesRadialDistribution(const Simulation<D>& simulation,
                            const RadialDistributionSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override { return 1 + pairs_.size(); }
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  struct Pair {
    std::string name;
    double number = 0.0;                  // of pairs of particles
    std::vector<double> contact_factors;  // of each distance near contact; empty: none
  };

  void add_pairs();
  double expected_pairs(double number, double low, double high) const;
  double edge(std::size_t bin) const { return low_ + width_ * static_cast<double>(bin); }
  std::size_t bins_of(std::size_t column) const { return 1 + pairs_.size() + column * bins_; }

  const Simulation<D>& simulation_;
  std::size_t bins_;
  double low_;               // smallest diameter
  double range_;             // of distances
  double width_;             // of a bin
  std::vector<Pair> pairs_;  // [S (S + 1)/2], see pair_index
  NearCells<D> cells_;
};

extern template class SpeciesRadialDistribution<2>;
extern template class SpeciesRadialDistribution<3>;

}  // namespace clatter
