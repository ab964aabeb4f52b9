#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/observables/observables.h"

namespace clatter {

/// The tables of the observables of a running simulation, since this object was made.
template <int D>
class LiveObservables {
 public:
  /// Observes a simulation in windows of length `window` (simulation time), whose scatter gives the
  /// standard errors.
  LiveObservables(Simulation<D>& simulation, const Measure& measure, double window);
  /// Continues the result of save(). The simulation must be at the same time under the same laws.
  LiveObservables(Simulation<D>& simulation, const Measure& measure, double window,
                  ArchiveReader& saved);
  LiveObservables(const LiveObservables&) = delete;
  LiveObservables& operator=(const LiveObservables&) = delete;

  /// The tables over the complete windows. They are computed again when the number of windows has
  /// grown by 5 % or by 32; with `now` also for a single window.
  std::shared_ptr<const std::vector<ResultTable>> tables(bool now);
  /// Writes the members that a checkpoint keeps.
  void save(ArchiveWriter& io);

 private:
  void watch();

  Measure measure_;
  double start_;   // simulation time
  double window_;  // duration of each
  std::uint64_t windows_ = 0;
  std::uint64_t told_ = 0;  // windows in tables_
  Observables<D> observables_;
  std::shared_ptr<const std::vector<ResultTable>> tables_ =
      std::make_shared<const std::vector<ResultTable>>();
  Timers<D> timers_;
};

extern template class LiveObservables<2>;
extern template class LiveObservables<3>;

}  // namespace clatter
