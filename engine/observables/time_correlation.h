#pragma once

#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/lag_history.h"
#include "engine/observables/observable.h"
#include "engine/observables/periodic_images.h"

namespace clatter {

/// Mean-squared displacement and mean drift of the unwrapped positions (theory 11.8), at the lags
/// of LagHistory, averaged over particles and origins. Table "mean_squared_displacement" with
/// columns for each axis and their sum.
template <int D>
class MeanSquaredDisplacement final : public Observable {
 public:
  MeanSquaredDisplacement(Simulation<D>& simulation, const TimeCorrelationSettings& settings)
      : simulation_(simulation), settings_(settings), history_(settings) {}

  void start() override;
  void sample() override;
  ObservableSums close_window() override;
  ObservableResult result(std::span<const ObservableSums> parts) const override;
  void save(ArchiveWriter& io) override { io(history_, *images_, sums_); }
  void restore(ArchiveReader& io) override;

 private:
  Simulation<D>& simulation_;
  TimeCorrelationSettings settings_;
  std::optional<PeriodicImages<D>> images_;  // present after the start
  LagHistory<D> history_;
  ObservableSums sums_;  // [lags][1 + 2 D] samples, then displacements and their squares
};

/// Autocorrelation <v_k(0) v_k(t)> of the velocities (theory 11.9), at the lags of LagHistory,
/// averaged over particles and origins. Table "velocity_autocorrelation" with columns for each axis
/// and their mean.
template <int D>
class VelocityAutocorrelation final : public Observable {
 public:
  VelocityAutocorrelation(const Simulation<D>& simulation, const TimeCorrelationSettings& settings)
      : simulation_(simulation), settings_(settings), history_(settings) {}

  void start() override;
  void sample() override;
  ObservableSums close_window() override;
  ObservableResult result(std::span<const ObservableSums> parts) const override;
  void save(ArchiveWriter& io) override { io(history_, sums_); }
  void restore(ArchiveReader& io) override;

 private:
  const Simulation<D>& simulation_;
  TimeCorrelationSettings settings_;
  LagHistory<D> history_;
  ObservableSums sums_;  // [lags][1 + D] samples, then products
};

extern template class MeanSquaredDisplacement<2>;
extern template class MeanSquaredDisplacement<3>;
extern template class VelocityAutocorrelation<2>;
extern template class VelocityAutocorrelation<3>;

}  // namespace clatter
