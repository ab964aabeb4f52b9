#pragma once

#include "engine/physics/state.h"

namespace clatter {

/// T = (m/2N) sum v^2 of a state; 0 where there are no particles.
double temperature_of(const State<2>& state);

}  // namespace clatter
