#pragma once

#include "engine/dynamics/simulation.h"

namespace clatter {

/// The mean diameter of the particles: a scale for cells that a few large ones do not widen. The
/// largest diameter without particles.
template <int D>
double mean_diameter(const Simulation<D>& simulation) {
  const std::size_t count = simulation.particles().size();
  if (!simulation.is_mixture() || count == 0) return simulation.model().diameter;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) sum += 2.0 * simulation.grain(i).radius;
  return sum / static_cast<double>(count);
}

}  // namespace clatter
