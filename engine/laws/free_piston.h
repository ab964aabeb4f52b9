#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/wall.h"

namespace clatter {

/// A rigid plate across the box that slides along an axis with walls (theory 13). It divides the
/// gas into two parts. Gravity does not act on it.
struct FreePiston {
  int axis = 0;                       ///< along which it slides
  double mass = 1.0;                  ///< > 0
  double thickness = 0.0;             ///< along the axis, >= 0
  double force = 0.0;                 ///< constant, along the axis: a weight
  bool pinned = false;                ///< whether it is held at rest
  double position = 0.0;              ///< of its middle at the start
  double speed = 0.0;                 ///< along the axis, at the start
  Wall law = {};                      ///< static
  std::vector<Wall> of_species = {};  ///< [S] the law for each species; empty: all have `law`

  /// The law for a species, by its number.
  const Wall& law_for(std::uint32_t species) const {
    return of_species.empty() ? law : of_species[species];
  }
  /// Acceleration of its free flight.
  double acceleration() const { return pinned ? 0.0 : force / mass; }
};

}  // namespace clatter
