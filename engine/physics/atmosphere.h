#pragma once

#include <vector>

#include "engine/vec.h"

namespace clatter {

/// An elastic gas in equilibrium between a floor and a lid, under gravity (theory 6.12). Masses,
/// diameters and Boltzmann's constant are 1.
struct Atmosphere {
  double count = 0.0;        ///< N > 0
  double floor = 0.0;        ///< width of the floor of disks, area of the floor of spheres
  double height = 0.0;       ///< from the floor to the lid, > 1
  double gravity = 0.0;      ///< g > 0
  double temperature = 0.0;  ///< T > 0, the same everywhere
  int dimension = 2;         ///< 2: disks, 3: spheres

  /// Heights above the floor and densities rho there, from the lowest centres of particles to the
  /// highest.
  std::vector<Vec2> profile() const;
};

}  // namespace clatter
