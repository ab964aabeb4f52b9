#pragma once

#include <cstdint>
#include <string>

#include "engine/dynamics/model.h"
#include "engine/dynamics/simulation.h"
#include "tests/engine/support/models.h"

namespace clatter::testing {

/// Particles at random places within equal plots of the box, with Gaussian velocities of
/// temperature 1; without walls the momentum is zero.
template <int D>
State<D> random_gas(const Model<D>& model, int count, std::uint64_t seed);

/// The same clear of wherever moving walls come, with spins where the model carries them.
template <int D>
State<D> clear_gas(const Model<D>& model, int count, std::uint64_t seed);

/// Deepest overlap of any two particles, through any image, and of any particle with a wall, in
/// diameters: every pair and every image is looked at.
double brute_force_overlap(const Model<2>& model, const State<2>& state);

/// Total momentum of the particles.
Vec2 momentum(const State<2>& state);

/// Whether every number of the state is finite and every centre lies in the box.
bool finite_and_inside(const Model<2>& model, const State<2>& state);

/// Runs to a time and gives the message of what stopped it before; empty: nothing did.
std::string stop_of(Simulation<2>& simulation, double time);

/// What a run must never show: a clock that steps back, particles that overlap where they collide.
/// A move of the base rounds times again, and may change the order of coinciding events: the clock
/// may step back by that rounding, no more.
void check_sound(const Simulation<2>& simulation);

}  // namespace clatter::testing
