#pragma once

#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Species by kinetic theory (theory 12.14-12.15, 12.22-12.23).
struct SpeciesTheory {
  std::vector<double> temperatures;  ///< [S] NaN: the theory has none for this species
  bool relative = false;             ///< T_s/T: without kicks T depends on the past of the gas
  std::vector<double> frictions;     ///< [S] gamma of one particle; NaN: the theory has none
  std::vector<double> diffusions;    ///< [S] D = T/(m gamma), as Einstein found; NaN: none
};

/// The theory of a scene with species.
SpeciesTheory species_theory(const Scene& scene);

}  // namespace clatter
