#pragma once

#include <cstdint>
#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/laws/model.h"
#include "tests/engine/support/models.h"

namespace clatter::testing {

/// The grains of a gas of particles that are alike.
inline const GrainArray kAlike;

/// Particles at random positions in equal plots of the box, with Gaussian velocities of temperature
/// 1. Without walls the momentum is zero.
template <int D>
State<D> random_gas(const Model<D>& model, int count, std::uint64_t seed);

/// The same gas outside the range of moving walls. With spins if the model has spins.
template <int D>
State<D> clear_gas(const Model<D>& model, int count, std::uint64_t seed);

/// The same particles, of which every second and third of three are of other species: their
/// diameters are those of the model divided by `ratio` and by its root, their masses and inertias
/// differ. Without walls the momentum becomes zero.
template <int D>
State<D> mixed(const Model<D>& model, State<D> state, double ratio);

/// The same particles with the flow of a sheared model.
template <int D>
State<D> in_flow(const Model<D>& model, State<D> state) {
  const Domain<D> domain = model.domain();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    state.velocities[i] += domain.flow(state.positions[i]);
  }
  return state;
}

/// A clear_gas with the flow of a sheared model.
template <int D>
State<D> gas_in_flow(const Model<D>& model, int count) {
  return in_flow<D>(model, clear_gas(model, count, 81));
}

/// A clear_gas with these species.
template <int D>
State<D> mixed_gas(const Model<D>& model, int count, std::uint64_t seed, double ratio);

/// Deepest overlap in diameters, of two particles through any image, or of a particle with a wall.
/// Tests every pair and every image.
template <int D>
double brute_force_overlap(const Model<D>& model, const State<D>& state);

/// Total momentum of the particles.
template <int D>
Vec<D> momentum(const State<D>& state);

/// Whether every number of the state is finite and every centre is in the box.
template <int D>
bool finite_and_inside(const Model<D>& model, const State<D>& state);

/// Runs to a time. Returns the message of an earlier stop; empty: no stop.
template <int D>
std::string stop_of(Simulation<D>& simulation, double time);

/// Checks of a run: the clock never steps back, and particles do not overlap at collisions.
/// Exception: a move of the base rounds times again, and may change the order of coinciding events.
/// The clock may then step back by this rounding error.
template <int D>
void check_sound(const Simulation<D>& simulation);

}  // namespace clatter::testing
