#pragma once

#include <optional>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"

namespace clatter {

/// Statistics of the hits of each wall (theory 11.3): the normal speeds of particles before and
/// after, and the energy gain. For each wall tables "wall_hits.SIDE.incoming" and "..outgoing", and
/// means "..mean_energy_gain" and "..mean_incoming_speed".
template <int D>
class WallHits final : public Observable, public Observer<D> {
 public:
  explicit WallHits(Simulation<D>& simulation) : simulation_(simulation) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void restore(ArchiveReader& io) override;

 private:
  void on_wall(const WallCollision<D>& collision) override;

  Simulation<D>& simulation_;
  std::optional<Observation<D>> observation_;  // present after the start
};

extern template class WallHits<2>;
extern template class WallHits<3>;

}  // namespace clatter
