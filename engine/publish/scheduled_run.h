#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/publish/snapshot.h"
#include "engine/publish/view_observers.h"
#include "engine/scene/schedule.h"

namespace clatter {

/// The simulation that a scene and a seed ask for, at time 0. Throws UserError where the machine
/// has not enough memory for it.
template <int D>
std::unique_ptr<Simulation<D>> simulation_of(const Scene& scene, std::uint64_t seed);

/// A simulation whose laws change as its scene says, and what is seen of it. At a change the
/// simulation is put aside and goes on under the new laws, so that all that watches it must be
/// handed over.
template <int D>
class ScheduledRun {
 public:
  /// From the start that the scene describes.
  ScheduledRun(const Scene& scene, std::uint64_t seed);
  /// Goes on from where a run was saved; the scene's changes up to then are in force.
  ScheduledRun(const Scene& scene, std::uint64_t seed, const RunState<D>& saved);

  /// The simulation, until laws change.
  Simulation<D>& simulation() { return *simulation_; }
  const Simulation<D>& simulation() const { return *simulation_; }  ///< likewise
  /// The scene with the laws in force, without its changes.
  const Scene& laws() const { return schedule_.laws(); }
  /// The scene with the laws in force, and all its changes.
  Scene scene() const { return schedule_.scene(); }
  /// Of every random number of the run.
  std::uint64_t seed() const { return seed_; }

  /// As Simulation::run_until: changes of that time are made. Throws PhysicalStop also where no gas
  /// can go on under new laws; the old ones then hold.
  bool run_until(double time, std::uint64_t collisions = kNoLimit, std::uint64_t steps = kNoLimit);
  /// Goes on by a few roundings of its time: however a run was halted before, one that runs until
  /// simulation().time() now has come through the same events. Where time stands still it stays
  /// there, and tells nothing: run_until throws.
  void settle();
  /// Laws that hold from the simulation's time on, where it settles first, and are among the
  /// scene's changes. Throws UserError or PhysicalStop where they cannot; the old ones then hold.
  void change(const std::vector<Override>& laws);

  /// From now on snapshots have all that the view shows, in pictures of a time `exposure` >= 0
  /// each: averages, flights, the angles by which particles have turned.
  void show(const View& view, double exposure = 0.0);
  /// Likewise, going on from what save_shown() gave at this time of a run with the same scene, view
  /// and exposure; empty: anew.
  void show(const View& view, const std::string& saved, double exposure = 0.0);
  /// What snapshots have of the time before, as it is now; empty: nothing.
  std::string save_shown() const;
  /// Goes on, to the bit, with another simulation, which only those watch whom on_change hands
  /// over: a simulation forgets no observer.
  void renew();
  /// The gas at the simulation's time.
  Snapshot snapshot();

  /// Called with the simulation to come while the one before still is simulation().
  std::function<void(Simulation<D>& next)> on_change;

 private:
  void change_laws(Schedule changed);
  void go_on_as(std::unique_ptr<Simulation<D>> next);

  Schedule schedule_;
  std::uint64_t seed_;
  std::unique_ptr<Simulation<D>> simulation_;
  View view_;
  double exposure_ = 0.0;
  std::unique_ptr<ViewObservers<D>> shown_;  // absent: nothing asked for
};

}  // namespace clatter
