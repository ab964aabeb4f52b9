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

template <int D>
void Residuals::include(const Imbalances<D>& window) {
  equations.resize(D + 2);
  for (std::vector<double>& cells : equations) cells.resize(window.gaps.size());
  for (std::size_t i = 0; i < window.gaps.size(); ++i) {
    const Conserved<D> residual = window.residual(i);
    for (int k = 0; k < D + 2; ++k) {
      double& largest = equations[k][i];
      if (std::fabs(residual[k]) > std::fabs(largest)) largest = residual[k];
    }
  }
}

void Residuals::include_numbers(const std::vector<double>& residuals, std::size_t species) {
  numbers.resize(species);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    double& largest = numbers[k % species];
    largest = std::max(largest, std::fabs(residuals[k]));
  }
}

std::vector<double> Residuals::largest() const {
  std::vector<double> largest;
  for (const std::vector<double>& cells : equations) {
    double& most = largest.emplace_back(0.0);
    for (const double residual : cells) most = std::max(most, std::fabs(residual));
  }
  return largest;
}

std::vector<double> Residuals::map(Field residual) const {
  if (equations.empty()) return {};
  return equations[equation_of(residual, static_cast<int>(equations.size()) - 2)];
}

void require_closed(const Residuals& residuals) {
  constexpr double kMaxRounding = 1e-6;
  std::vector<double> all = residuals.largest();
  all.insert(all.end(), residuals.numbers.begin(), residuals.numbers.end());
  const double largest = std::ranges::max(all);
  if (largest <= kMaxRounding) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", largest);
  throw RunError(std::string("the balance equations do not close: residuals are as large as ") +
                 text + "; please report this scene and seed");
}

template void Residuals::include(const Imbalances<2>&);
template void Residuals::include(const Imbalances<3>&);

}  // namespace clatter
