#pragma once

#include <deque>

#include "engine/measure/cell_integrals.h"
#include "engine/publish/snapshot.h"
#include "engine/scene/scene.h"

namespace clatter {

/// A field averaged over the last window of time, as the view shows it while a run goes on.
class LiveField {
 public:
  /// Watches the simulation through `view.field`, which the view must have, on cells of about one
  /// diameter (at most 512 along an axis); the average reaches back by view.window, or by up to an
  /// eighth more.
  LiveField(Simulation<2>& simulation, const View& view);
  /// Goes on where that of the simulation before ended: this one has its disks at its time, under
  /// other laws.
  LiveField(Simulation<2>& simulation, const View& view, LiveField&& before);

  /// The field averaged over the window up to the simulation's time, or since the start where that
  /// is less.
  FieldMap map();

 private:
  static constexpr int kParts = 8;  // the window moves on by one part at a time

  void close_parts(Simulation<2>& simulation, double part);

  Field field_;
  CellIntegrals<2> integrals_;
  std::deque<CellSums> parts_;  // closed parts, oldest first
  CellSums open_;               // the part under way, up to the last look
  double start_;                // simulation time from which parts are counted
  std::uint64_t closed_ = 0;    // parts since then
};

}  // namespace clatter
