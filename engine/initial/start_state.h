#pragma once

#include <cstdint>

#include "engine/dynamics/model.h"
#include "engine/scene/scene.h"
#include "engine/stop_request.h"

namespace clatter {

/// The state of a scene at time 0, a pure function of scene and seed. No particles overlap.
/// Velocities are Gaussian with mean 0 (N >= 2) and exactly the start temperature. Spins, if the
/// scene has them, are Gaussian with exactly their temperature I <omega^2>. Particles are outside
/// of the range of moving walls. With layout File the state comes from the file.
///
/// A random layout uses random insertion up to a packing fraction of 0.54 for disks and 0.37 for
/// spheres. Up to 0.7 and 0.54, where a fluid exists, it melts a lattice. Above it is a lattice
/// with random vacancies. From 0.49 on a crystal of spheres is stable beside the fluid, and some of
/// its order may remain. The scene must be validated: its count fits one of the lattices.
/// Throws Interrupted.
template <int D>
State<D> start_state(const Scene& scene, std::uint64_t seed, const StopRequest& stop = {});

}  // namespace clatter
