#pragma once

#include <vector>

#include "engine/measure/balance.h"
#include "engine/scene/field.h"

namespace clatter {

/// Where the equation of a residual stands in Conserved<D>.
int equation_of(Field residual, int dimension);

/// How the balance equations closed in the windows of a run.
struct Residuals {
  /// [D + 2][cells], in the order of Conserved<D>, cell (i, j) at i + j cells.x(): in each cell the
  /// residual of the window in which its magnitude was largest.
  std::vector<std::vector<double>> equations;

  /// Takes a further window of the same cells into account.
  template <int D>
  void include(const Imbalances<D>& window);
  /// The largest magnitude of each equation's residuals; [D + 2], empty before the first window.
  std::vector<double> largest() const;
  /// Those of one equation; [cells], empty before the first window.
  std::vector<double> map(Field residual) const;
};

/// Throws RunError where cells gained something else than was booked to them, beyond rounding.
void require_closed(const Residuals& residuals);

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Residuals& residuals) {
  auto& [equations] = residuals;
  io(equations);
}

extern template void Residuals::include(const Imbalances<2>&);
extern template void Residuals::include(const Imbalances<3>&);

}  // namespace clatter
