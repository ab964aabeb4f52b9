#pragma once

#include <vector>

#include "engine/measure/balance.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Where the equation of a residual stands in Conserved<D>.
int equation_of(Field residual, int dimension);

/// How the balance equations closed in the windows of a run.
struct Residuals {
  /// [cells], cell (i, j) at i + j cells.x(): of each equation the residual of the window in which
  /// its magnitude was largest.
  std::vector<Conserved<2>> cells;

  /// Takes a further window of the same cells into account.
  void include(const Imbalances<2>& window);
  /// The largest magnitude of each equation's residuals.
  Conserved<2> largest() const;
  /// Those of one equation; [cells].
  std::vector<double> map(Field residual) const;
};

/// Throws RunError where cells gained something else than was booked to them, beyond rounding.
void require_closed(const Residuals& residuals);

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Residuals& residuals) {
  auto& [cells] = residuals;
  io(cells);
}

}  // namespace clatter
