#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/observables/lag_history.h"
#include "engine/observables/near_cells.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Hexagonal bond order of disks: psi_6 of each disk, the mean of exp(6 i theta) over the
/// directions to its neighbours within a range (theory 11.12). The means are "bond_order.local" and
/// "bond_order.global". Table "bond_order" has the autocorrelation of psi_6 in time.
class BondOrder final : public Observable {
 public:
  BondOrder(const Simulation<2>& simulation, const BondOrderSettings& settings);

  std::size_t size() const override { return 3 + 2 * history_.lags().size(); }
  std::size_t mean_size() const override { return 3; }
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  std::vector<Vec<2>> orders();

  const Simulation<2>& simulation_;
  TimeCorrelationSettings lags_;
  double range_;  // in distances of centres at contact
  NearCells<2> cells_;
  LagHistory<2> history_;
};

}  // namespace clatter
