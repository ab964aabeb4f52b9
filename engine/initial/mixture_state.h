#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/model.h"
#include "engine/physics/grain.h"
#include "engine/physics/state.h"
#include "engine/stop_request.h"

namespace clatter {

/// A state of particles of different sizes and masses at random places, see OverlapRemoval. All
/// species have the temperature: velocities are Gaussian of variance T/m, the total momentum is 0,
/// and (1/DN) sum m v^2 is exactly T. Near particles have near numbers. Without particles if they
/// find no room. Throws Interrupted.
template <int D>
State<D> mixture_state(const Model<D>& model, const std::vector<Grain>& grains, double temperature,
                       std::uint64_t seed, const StopRequest& stop = {});

extern template State<2> mixture_state(const Model<2>&, const std::vector<Grain>&, double,
                                       std::uint64_t, const StopRequest&);
extern template State<3> mixture_state(const Model<3>&, const std::vector<Grain>&, double,
                                       std::uint64_t, const StopRequest&);

}  // namespace clatter
