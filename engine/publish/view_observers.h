#pragma once

#include <optional>
#include <string>

#include "engine/checkpoint/archive.h"
#include "engine/publish/flight_recorder.h"
#include "engine/publish/live_field.h"
#include "engine/publish/spin_angles.h"

namespace clatter {

/// What watches a simulation so that pictures can show more than its state at an instant; no more
/// of it than they do show.
template <int D>
class ViewObservers {
 public:
  /// Watches for `view`, in pictures that each show a time `exposure` >= 0; from now on, or going
  /// on with all that those `before` have of it, whose simulation had its particles there at its
  /// time.
  ViewObservers(Simulation<D>& simulation, const View& view, double exposure,
                ViewObservers* before = nullptr);
  /// Goes on where those that were saved ended: the simulation is at that time, under those laws.
  /// Throws UserError where they watched for another view.
  ViewObservers(Simulation<D>& simulation, const View& view, double exposure, ArchiveReader saved);
  ViewObservers(const ViewObservers&) = delete;
  ViewObservers& operator=(const ViewObservers&) = delete;

  /// All that pictures to come depend on, beside simulation and view; empty: nothing.
  std::string save();
  /// Puts into the snapshot what the view shows at the simulation's time.
  void publish(Snapshot& snapshot);

 private:
  void watch_field(Simulation<D>& simulation, ViewObservers* before);
  void watch_flights(Simulation<D>& simulation, ViewObservers* before);
  void watch_spins(Simulation<D>& simulation, ViewObservers* before);

  View view_;
  double exposure_;
  std::optional<LiveField<D>> field_;
  std::optional<FlightRecorder<D>> flights_;
  std::optional<SpinAngles> angles_;  // where disks spin
};

}  // namespace clatter
