#pragma once

#include <cstdint>

#include "engine/dynamics/model.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The state at time 0 that a scene asks for, a pure function of scene and seed: no particles
/// overlap, the velocities are Gaussian with mean 0 (N >= 2) and exactly the start temperature, and
/// spins, where the scene has them, Gaussian with exactly their temperature I <omega^2>. Particles
/// keep clear of wherever a moving wall comes. A scene with layout File has the state itself.
///
/// A random layout is made by random insertion up to a packing fraction of 0.54 for disks and 0.37
/// for spheres, by melting a lattice while there is a fluid (0.7 and 0.54), and is a face-centred
/// lattice with random vacancies beyond. From 0.49 on, where a crystal of spheres is stable beside
/// the fluid, some of its order may stay. The scene has been validated: its count fits one of the
/// lattices.
template <int D>
State<D> start_state(const Scene& scene, std::uint64_t seed);

}  // namespace clatter
