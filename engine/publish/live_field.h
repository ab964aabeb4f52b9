#pragma once

#include <optional>

#include "engine/checkpoint/archive.h"
#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/publish/moving_sum.h"
#include "engine/publish/snapshot.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Fields over the last window of time, as the view shows them while a run goes on: averages, or
/// how balance equations close.
template <int D>
class LiveField {
 public:
  /// Watches the simulation through `view.field` and `view.arrows`, of which the view must have
  /// one, on cells of about one diameter (at most 512 along an axis, of three 64); the window
  /// reaches back by view.window, or by up to an eighth more.
  LiveField(Simulation<D>& simulation, const View& view);
  /// Goes on where that of the simulation before ended: this one has its particles at its time,
  /// under other laws.
  LiveField(Simulation<D>& simulation, const View& view, LiveField&& before);
  /// Goes on where one that was saved ended: the simulation is at that time, under those laws.
  /// Throws UserError where the view is another one.
  LiveField(Simulation<D>& simulation, const View& view, ArchiveReader saved);
  LiveField(const LiveField&) = delete;
  LiveField& operator=(const LiveField&) = delete;

  /// All that the averages to come depend on, beside simulation and view. Nothing changes by it.
  std::string save();

  /// Puts into the snapshot what the view shows, over the window up to the simulation's time, or
  /// since the start where that is less.
  void publish(Snapshot& snapshot);

 private:
  struct Averages {
    CellIntegrals<D> observer;
    MovingSum<CellSums> sums;
  };
  struct Closure {
    Balance<D> observer;
    MovingSum<Imbalances<D>> sums;

    FieldMap map(Field field) const;
  };

  template <class Archive>
  void visit(Archive& io);
  static std::optional<Averages> averages_for(const Simulation<D>& simulation, const View& view);
  static std::optional<Closure> closure_for(const Simulation<D>& simulation, const View& view);
  void watch(Simulation<D>& simulation, const View& view);
  void look();

  std::optional<Field> field_;
  std::optional<Quantity> arrows_;
  std::optional<Averages> averages_;  // where there are arrows, or the field is an average
  std::optional<Closure> closure_;    // where the field is a residual
  double start_;                      // simulation time at which the first part closes
  std::uint64_t closed_ = 0;          // parts since then
  double sampled_from_;               // simulation time of the first sample, of snapshots
  std::uint64_t samples_ = 0;         // since then
};

}  // namespace clatter
