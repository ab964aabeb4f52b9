#pragma once

#include <variant>

#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/measure/moving_sum.h"
#include "engine/publish/snapshot.h"
#include "engine/scene/scene.h"

namespace clatter {

/// A field over the last window of time, as the view shows it while a run goes on: an average, or
/// how balance equations close.
class LiveField {
 public:
  /// Watches the simulation through `view.field`, which the view must have, on cells of about one
  /// diameter (at most 512 along an axis); the window reaches back by view.window, or by up to an
  /// eighth more.
  LiveField(Simulation<2>& simulation, const View& view);

  /// The field of the window up to the simulation's time, or since the start where that is less.
  FieldMap map();

 private:
  /// Of a field that is an average.
  struct Average {
    CellIntegrals<2> observer;
    MovingSum<CellSums> sums;

    void look() { sums.add(observer.close_window()); }
    FieldMap map(Field field) const;
  };
  /// Of one that is a residual.
  struct Closure {
    Balance<2> observer;
    MovingSum<Imbalances<2>> sums;

    void look() { sums.add(observer.close_window().imbalances); }
    FieldMap map(Field field) const;
  };
  using Watch = std::variant<Average, Closure>;

  static Watch watch_of(const Simulation<2>& simulation, Field field);

  Field field_;
  Watch watch_;
};

}  // namespace clatter
