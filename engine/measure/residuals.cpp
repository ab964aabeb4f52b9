#include "engine/measure/residuals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "engine/error.h"

namespace clatter {

int equation_of(Field residual, int dimension) {
  switch (residual.quantity) {
    case Quantity::BalanceMomentum:
      return 1 + residual.i;
    case Quantity::BalanceEnergy:
      return 1 + dimension;
    default:
      return 0;
  }
}

void Residuals::include(const Imbalances<2>& window) {
  cells.resize(window.gaps.size(), Conserved<2>::Zero());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Conserved<2> residual = window.residual(i);
    for (int k = 0; k < residual.size(); ++k) {
      if (std::fabs(residual[k]) > std::fabs(cells[i][k])) cells[i][k] = residual[k];
    }
  }
}

Conserved<2> Residuals::largest() const {
  Conserved<2> largest = Conserved<2>::Zero();
  for (const Conserved<2>& cell : cells) {
    largest = largest.cwiseMax(cell.cwiseAbs());
  }
  return largest;
}

std::vector<double> Residuals::map(Field residual) const {
  std::vector<double> values;
  values.reserve(cells.size());
  for (const Conserved<2>& cell : cells) values.push_back(cell[equation_of(residual, 2)]);
  return values;
}

void require_closed(const Residuals& residuals) {
  constexpr double kMaxRounding = 1e-6;
  const double largest = residuals.largest().maxCoeff();
  if (largest <= kMaxRounding) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", largest);
  throw RunError(std::string("the balance equations do not close: residuals are as large as ") +
                 text + "; please report this scene and seed");
}

}  // namespace clatter
