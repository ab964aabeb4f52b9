#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/observables/region.h"
#include "engine/scene/observable_settings.h"
#include "engine/statistics/part_sums.h"

namespace clatter {

/// Density, temperature and mean velocity of the particles in a region, sampled over time (theory
/// 11.18). Table "probe.series" has up to kRows rows; when these are full, neighbours are joined.
/// Means "probe.density", "..temperature", "..number_variance", "..velocity_x" and so on.
template <int D>
class Probe final : public Observable {
 public:
  /// Largest number of rows of the series.
  static constexpr std::size_t kRows = 4096;

  Probe(const Simulation<D>& simulation, const ProbeSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  ResultTable series() const;

  const Simulation<D>& simulation_;
  Region<D> region_;
  PartSums<ObservableSums, kRows> rows_;  // since the start
};

extern template class Probe<2>;
extern template class Probe<3>;

}  // namespace clatter
