#pragma once

#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Temperatures of species by kinetic theory (theory 12.14-12.15).
struct SpeciesTheory {
  std::vector<double> temperatures;  ///< [S] NaN: the theory has none for this species
  bool relative = false;             ///< T_s/T: without kicks T depends on the past of the gas
};

/// The theory of a scene with species. Takes some 0.1 s for a species of unequal diameters that
/// loses energy.
SpeciesTheory species_theory(const Scene& scene);

}  // namespace clatter
