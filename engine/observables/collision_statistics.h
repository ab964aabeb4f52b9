#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"

namespace clatter {

/// Statistics of all collisions of particles (theory 11.2): impact parameter, normal and tangential
/// impact speed of the centres, and dissipated energy. Tables "collisions.impact_parameter",
/// "..normal_speed", "..tangential_speed" and, if collisions dissipated, "..energy_loss"; their
/// means have the same names with "mean_" before the last word. "collisions.sliding_share" is the
/// share of the collisions with finite friction that reach the Coulomb limit.
/// "collisions.recollision_share" is the share of the collisions of two particles whose last
/// collision was with each other.
template <int D>
class CollisionStatistics final : public Observable, public Observer<D> {
 public:
  explicit CollisionStatistics(Simulation<D>& simulation) : simulation_(simulation) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  void on_collision(const PairCollision<D>& collision) override;

  Simulation<D>& simulation_;
  std::vector<std::uint32_t>
      partners_;  // [N] of the last collision; its own number before the first
  std::optional<Observation<D>> observation_;  // present after the start
};

extern template class CollisionStatistics<2>;
extern template class CollisionStatistics<3>;

}  // namespace clatter
