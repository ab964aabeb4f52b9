#pragma once

#include <cstdint>

#include "engine/dynamics/simulation.h"

namespace clatter {

/// Whether two particles that NearCells has found are within `range` times the distance of their
/// centres at contact. All pairs of particles that are alike are.
template <int D>
bool are_near(const Simulation<D>& simulation, std::uint32_t first, std::uint32_t second,
              const Vec<D>& apart, double range) {
  if (!simulation.is_mixture()) return true;
  const double contact = simulation.grain(first).radius + simulation.grain(second).radius;
  return apart.squaredNorm() <= range * range * contact * contact;
}

}  // namespace clatter
