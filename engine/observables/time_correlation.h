#pragma once

#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/lag_history.h"
#include "engine/observables/observable.h"
#include "engine/observables/periodic_images.h"
#include "engine/observables/species_groups.h"

namespace clatter {

/// Mean-squared displacement and mean drift of the unwrapped positions (theory 11.8), at the lags
/// of LagHistory, averaged over particles and origins. Table "mean_squared_displacement" with
/// columns for each axis and their sum; of a mixture also for each species. The sums are
/// [lags][1 + 2 D groups]: samples, then displacements and their squares of all particles and of
/// each species.
template <int D>
class MeanSquaredDisplacement final : public Observable {
 public:
  MeanSquaredDisplacement(Simulation<D>& simulation, const TimeCorrelationSettings& settings)
      : simulation_(simulation), settings_(settings), groups_(simulation), history_(settings) {}

  std::size_t size() const override { return history_.lags().size() * row_size(); }
  std::size_t mean_size() const override { return 0; }
  void start() override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  std::size_t row_size() const { return 1 + 2 * D * groups_.count(); }

  Simulation<D>& simulation_;
  TimeCorrelationSettings settings_;
  SpeciesGroups<D> groups_;
  std::optional<PeriodicImages<D>> images_;  // present after the start
  LagHistory<D> history_;
};

/// Autocorrelation <v_k(0) v_k(t)> of the velocities (theory 11.9), at the lags of LagHistory,
/// averaged over particles and origins. Table "velocity_autocorrelation" with columns for each axis
/// and their mean; of a mixture also for each species. The sums are [lags][1 + D groups]: samples,
/// then products of all particles and of each species.
template <int D>
class VelocityAutocorrelation final : public Observable {
 public:
  VelocityAutocorrelation(const Simulation<D>& simulation, const TimeCorrelationSettings& settings)
      : simulation_(simulation), settings_(settings), groups_(simulation), history_(settings) {}

  std::size_t size() const override { return history_.lags().size() * row_size(); }
  std::size_t mean_size() const override { return 0; }
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  std::size_t row_size() const { return 1 + D * groups_.count(); }

  const Simulation<D>& simulation_;
  TimeCorrelationSettings settings_;
  SpeciesGroups<D> groups_;
  LagHistory<D> history_;
};

extern template class MeanSquaredDisplacement<2>;
extern template class MeanSquaredDisplacement<3>;
extern template class VelocityAutocorrelation<2>;
extern template class VelocityAutocorrelation<3>;

}  // namespace clatter
