#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"

namespace clatter {

/// Statistics of all collisions of particles (theory 11.2): impact parameter, normal and tangential
/// impact speed of the centres, and dissipated energy. Tables "collisions.impact_parameter",
/// "..normal_speed", "..tangential_speed" and, where collisions dissipate, "..energy_loss"; their
/// means have the same names with "mean_" before the last word. With finite friction
/// "collisions.sliding_share" is the share of collisions that reach the Coulomb limit.
template <int D>
class CollisionStatistics final : public Observable, private Observer<D> {
 public:
  explicit CollisionStatistics(Simulation<D>& simulation) : simulation_(simulation) {}

  void start() override;
  ObservableSums close_window() override;
  ObservableResult result(std::span<const ObservableSums> parts) const override;
  void save(ArchiveWriter& io) override { io(sums_); }
  void restore(ArchiveReader& io) override;

 private:
  void on_collision(const PairCollision<D>& collision) override;

  Simulation<D>& simulation_;
  ObservableSums sums_;
};

extern template class CollisionStatistics<2>;
extern template class CollisionStatistics<3>;

}  // namespace clatter
