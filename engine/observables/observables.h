#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/scene/scene.h"
#include "engine/statistics/part_sums.h"

namespace clatter {

/// The requested observables of a run, and their sums over windows of time.
template <int D>
class Observables {
 public:
  /// The observables of [measure] on a simulation, which must outlive this object.
  Observables(Simulation<D>& simulation, const Measure& measure);

  /// Begins to accumulate, at the simulation's time.
  void start();
  /// Adds the timers of samples: each interval after `begin`. Samples that a checkpoint contains
  /// are skipped.
  void add_timers(Timers<D>& timers, double begin);
  /// Ends a window of time. All windows have the same length.
  void close_window();
  /// The results of all windows.
  std::vector<ObservableResult> results() const;

  /// Writes the members that a checkpoint keeps.
  void save(ArchiveWriter& io);
  /// Reads them and continues. The simulation must be at the same time. `begin` is that of
  /// add_timers().
  void restore(ArchiveReader& io, double begin);

 private:
  struct Part {
    std::unique_ptr<Observable> observable;
    std::optional<double> interval;       // between samples; absent: it follows events
    PartSums<ObservableSums, 1024> fine;  // of the sums that the means need
    PartSums<ObservableSums> coarse;      // of all sums
    std::uint64_t samples = 0;
  };

  Simulation<D>& simulation_;
  std::vector<Part> parts_;
  bool started_ = false;
};

/// The names of all tables that observables may have.
std::vector<std::string> observable_tables();

/// Upper estimate of the memory of the observables of a scene, in bytes, after all its puffs.
double observables_memory(const Scene& scene);

extern template class Observables<2>;
extern template class Observables<3>;

}  // namespace clatter
