#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/model.h"
#include "engine/physics/grain.h"
#include "engine/physics/state.h"
#include "engine/scene/scene.h"
#include "engine/stop_request.h"

namespace clatter {

/// What the particles of a mixture are, species by species; empty without species.
std::vector<Grain> grains_of(const Scene& scene);

/// The state of grains at places without overlaps, as many. All species have the temperature:
/// velocities are Gaussian of variance T/m, the total momentum is 0, and (1/DN) sum m v^2 is
/// exactly T. Species follow each other in the numbers of particles, and near particles of a
/// species have near numbers. Throws Interrupted.
template <int D>
State<D> state_at_places(const std::vector<Vec<D>>& places, const std::vector<Grain>& grains,
                         double temperature, std::uint64_t seed, const StopRequest& stop = {});

/// state_at_places() at random places, see OverlapRemoval. Without particles if they find no room.
/// Throws Interrupted.
template <int D>
State<D> mixture_state(const Model<D>& model, const std::vector<Grain>& grains, double temperature,
                       std::uint64_t seed, const StopRequest& stop = {});

extern template State<2> state_at_places(const std::vector<Vec<2>>&, const std::vector<Grain>&,
                                         double, std::uint64_t, const StopRequest&);
extern template State<3> state_at_places(const std::vector<Vec<3>>&, const std::vector<Grain>&,
                                         double, std::uint64_t, const StopRequest&);
extern template State<2> mixture_state(const Model<2>&, const std::vector<Grain>&, double,
                                       std::uint64_t, const StopRequest&);
extern template State<3> mixture_state(const Model<3>&, const std::vector<Grain>&, double,
                                       std::uint64_t, const StopRequest&);

}  // namespace clatter
