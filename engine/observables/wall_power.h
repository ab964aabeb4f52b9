#pragma once

#include <array>
#include <optional>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Distribution of the power of the walls, averaged over consecutive intervals (theory 11.13).
/// Tables "wall_power.SIDE" and "wall_power.total", means "..mean" and "..variance" of each.
template <int D>
class WallPower final : public Observable, public Observer<D> {
 public:
  WallPower(Simulation<D>& simulation, const WallPowerSettings& settings)
      : simulation_(simulation), settings_(settings) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  void on_wall(const WallCollision<D>& collision) override;

  Simulation<D>& simulation_;
  WallPowerSettings settings_;
  std::array<double, 2 * D> energy_{};         // from each wall since the last sample
  std::optional<Observation<D>> observation_;  // present after the start
};

extern template class WallPower<2>;
extern template class WallPower<3>;

}  // namespace clatter
