#pragma once

#include <vector>

#include "engine/scene/species.h"
#include "render/palette.h"

namespace clatter {

/// The colour of each species: its own, or one of eight for particles over this ground. The eight
/// remain distinguishable for the colour-blind; they repeat after the eighth species.
std::vector<Colour> species_colours(const std::vector<Species>& species, Colour ground);

}  // namespace clatter
