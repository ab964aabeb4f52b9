#pragma once

#include <deque>

#include "engine/measure/cell_integrals.h"
#include "engine/publish/snapshot.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Fields averaged over the last window of time, as the view shows them while a run goes on.
class LiveField {
 public:
  /// Watches the simulation through `view.field` and `view.arrows`, of which the view must have
  /// one, on cells of about one diameter (at most 512 along an axis); the average reaches back by
  /// view.window, or by up to an eighth more.
  LiveField(Simulation<2>& simulation, const View& view);

  /// Puts into the snapshot what the view shows, averaged over the window up to the simulation's
  /// time, or since the start where that is less.
  void publish(Snapshot& snapshot);

 private:
  static constexpr int kParts = 8;  // the window moves on by one part at a time

  CellSums last_window();
  FieldMap map_of(const CellSums& sums) const;
  ArrowMap arrows_of(const CellSums& sums) const;

  std::optional<Field> field_;
  std::optional<Arrows> arrows_;
  CellIntegrals<2> integrals_;
  std::deque<CellSums> parts_;  // closed parts, oldest first
  CellSums open_;               // the part under way, up to the last look
};

}  // namespace clatter
