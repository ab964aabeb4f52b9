#pragma once

#include <optional>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/observables/periodic_images.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Net number of particles that cross a plane in the direction of its normal, in consecutive
/// intervals (theory 11.14). Table "plane_current.number", means "plane_current.number" and
/// "..number_variance".
template <int D>
class PlaneCurrent final : public Observable {
 public:
  PlaneCurrent(Simulation<D>& simulation, const PlaneCurrentSettings& settings)
      : simulation_(simulation), settings_(settings) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  std::int64_t beyond() const;

  Simulation<D>& simulation_;
  PlaneCurrentSettings settings_;
  std::optional<PeriodicImages<D>> images_;  // present after the start
  std::int64_t beyond_ = 0;                  // at the last sample or the start
};

extern template class PlaneCurrent<2>;
extern template class PlaneCurrent<3>;

}  // namespace clatter
