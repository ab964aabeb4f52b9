#pragma once

#include "engine/physics/state.h"

namespace clatter {

/// T = (m/DN) sum v^2 of a state; 0 without particles.
template <int D>
double temperature_of(const State<D>& state);

}  // namespace clatter
