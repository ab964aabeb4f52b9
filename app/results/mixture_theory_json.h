#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/physics/mixture_theory.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The mixture of a scene with species. Species of unequal diameters have several components.
MixtureGas mixture_gas(const Scene& scene);

/// Whether collisions of particles of a scene lose energy, with or without species. Pairs that
/// cannot collide, for want of particles, do not count.
bool dissipates(const Scene& scene);

/// The predictions of kinetic theory for a scene with species (theory 12.10-12.15): contact values
/// of each pair, and in a box without walls temperatures, pressure and rates of collisions.
nlohmann::ordered_json mixture_theory_json(const Scene& scene);

}  // namespace clatter
