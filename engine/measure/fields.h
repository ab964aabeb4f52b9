#pragma once

#include <deque>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/publish/snapshot.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Value of a field in a cell, Eqs. (4.4)-(4.16): density rho, velocity V, T_k = <v_k^2> - V_k^2,
/// T = (T_x + T_y)/2. `measure` is the averaging time times the cell's area. NaN for all but the
/// density where no disk ever was.
double field_value(Field field, const CellMoments<2>& moments, double measure);

/// A field averaged over the last window of time, as the view shows it while a run goes on.
class LiveField {
 public:
  /// Watches the simulation through `view.field`, which the view must have, on cells of about one
  /// diameter (at most 512 along an axis); the average reaches back by view.window, or by up to an
  /// eighth more.
  LiveField(Simulation<2>& simulation, const View& view);

  /// The field averaged over the window up to the simulation's time, or since the start where that
  /// is less.
  FieldMap map();

 private:
  static constexpr int kParts = 8;  // the window moves on by one part at a time
  using Grid = std::vector<CellMoments<2>>;

  void close_part();

  const Simulation<2>& simulation_;
  Field field_;
  CellIntegrals<2> integrals_;
  std::deque<Grid> parts_;    // closed parts, oldest first
  std::deque<double> spans_;  // their durations
  Grid open_;                 // the part under way, up to open_until_
  double open_span_ = 0.0;
  double open_until_ = 0.0;  // simulation time
};

}  // namespace clatter
