#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/observables/near_cells.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Clusters of particles that are connected by distances within a range (theory 11.11). Table
/// "clusters.size" has the mean number of clusters of a size; "clusters.growth" has the means over
/// parts of the run. The means are "clusters.number", "clusters.largest" and "clusters.mean_size".
template <int D>
class Clusters final : public Observable {
 public:
  Clusters(const Simulation<D>& simulation, const ClusterSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  std::size_t root_of(std::size_t particle);
  void join(std::size_t first, std::size_t second);

  const Simulation<D>& simulation_;
  double range_;  // in distances of centres at contact
  NearCells<D> cells_;
  std::vector<std::size_t> parent_;  // [N] trees of connected particles; a root is its own parent
  std::vector<std::size_t> sizes_;   // [N] particles of the tree, at roots
};

extern template class Clusters<2>;
extern template class Clusters<3>;

}  // namespace clatter
