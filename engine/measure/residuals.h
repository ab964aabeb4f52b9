#pragma once

#include <vector>

#include "engine/measure/balance.h"
#include "engine/scene/field.h"

namespace clatter {

/// Index of a residual's equation in Conserved<D>.
int equation_of(Field residual, int dimension);

/// Largest residuals of the balance equations over the windows of a run.
struct Residuals {
  /// [D + 2][cells], in the order of Conserved<D>, cell (i, j) at i + j cells.x(): in each cell the
  /// residual of largest magnitude over the windows.
  std::vector<std::vector<double>> equations;
  /// [S] of the numbers of each species: the largest magnitude; empty if particles are alike.
  std::vector<double> numbers = {};

  /// Includes another window of the same cells.
  template <int D>
  void include(const Imbalances<D>& window);
  /// Includes the residuals of numbers of a window, [cells][species].
  void include_numbers(const std::vector<double>& residuals, std::size_t species);
  /// The largest magnitude of each equation's residuals; [D + 2], empty before the first window.
  std::vector<double> largest() const;
  /// The residuals of one equation; [cells], empty before the first window.
  std::vector<double> map(Field residual) const;
};

/// Throws RunError if a residual exceeds rounding (1e-6).
void require_closed(const Residuals& residuals);

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Residuals& residuals) {
  auto& [equations, numbers] = residuals;
  io(equations, numbers);
}

extern template void Residuals::include(const Imbalances<2>&);
extern template void Residuals::include(const Imbalances<3>&);

}  // namespace clatter
