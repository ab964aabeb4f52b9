#pragma once

#include <optional>
#include <string>

#include "engine/checkpoint/archive.h"
#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/picture/moving_sum.h"
#include "engine/picture/snapshot.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Fields of the view during a run, over the last window of time: averages, or residuals of the
/// balance equations.
template <int D>
class LiveField {
 public:
  /// Watches the simulation for `view.field` and `view.arrows`; the view must have at least one of
  /// them. Cells are about one mean diameter of the particles wide, at most 512 along an axis in
  /// 2D and 64 in 3D. The window has the length view.window, or up to an eighth more.
  LiveField(Simulation<D>& simulation, const View& view);
  /// Continues the field `before` of the same simulation.
  LiveField(Simulation<D>& simulation, const View& view, LiveField&& before);
  /// Continues a saved field. The simulation must be at the same time under the same laws. Throws
  /// UserError if the view is another one.
  LiveField(Simulation<D>& simulation, const View& view, ArchiveReader saved);
  LiveField(const LiveField&) = delete;
  LiveField& operator=(const LiveField&) = delete;

  /// The state that determines later averages, together with simulation and view. Saving does not
  /// change the averages.
  std::string save();

  /// Ends the present part of the averages, before the laws change.
  void look();
  /// Writes the field and arrows of the view into the snapshot. They are averages over the window
  /// up to the simulation's time, or since the start if that is shorter. In a sheared box arrows of
  /// the velocity include the flow, and fields do not.
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
  static std::string species_of(const Simulation<D>& simulation, const View& view);
  static std::optional<Averages> averages_for(const Simulation<D>& simulation, const View& view);
  static std::optional<Closure> closure_for(const Simulation<D>& simulation, const View& view);
  bool samples(const View& view) const;
  void watch(Simulation<D>& simulation, const View& view);

  const Simulation<D>& simulation_;
  std::optional<Field> field_;
  std::string species_;  // name of the field's species
  std::optional<Quantity> arrows_;
  std::optional<Averages> averages_;  // present with arrows, or if the field is an average
  std::optional<Closure> closure_;    // present if the field is a residual
  double start_;                      // simulation time at which the first part closes
  std::uint64_t closed_ = 0;          // parts closed since then
  double sampled_from_;               // simulation time of the first sample (snapshot estimator)
  std::uint64_t samples_ = 0;         // samples since then
  std::optional<Observation<D>> of_averages_, of_closure_;
  Timers<D> timers_;
};

}  // namespace clatter
