#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/dynamics/run_state.h"
#include "engine/error.h"
#include "engine/laws/model.h"
#include "engine/physics/state.h"

namespace clatter {

// The start of a run: from a state, or from a saved run under other laws.

/// The state of a run before its first event: particles of a state at a simulation time.
template <int D>
RunState<D> first_state(const Model<D>& model, State<D> state, double start_time);

/// The shifts of phases, by side, that keep walls at their places if their frequencies change now.
template <int D>
std::array<double, 2 * D> phase_shifts(const Model<D>& model, const RunState<D>& saved);

/// The shear_phase that keeps the images of a sheared box at their places if its rate changes now.
template <int D>
double shear_phase(const Model<D>& model, const RunState<D>& saved);

/// A flight that begins now, at a time on the base, under other laws than those of the former
/// state. Its peculiar velocity stays.
template <int D>
Flight<D> flight_from_now(const Flight<D>& flight, const Model<D>& model, const RunState<D>& former,
                          double now);

/// Begins new flights now if flights do not continue under these laws. Predictions along a flight
/// begin at its start.
template <int D>
void restart_changed_flights(const Model<D>& model, RunState<D>& saved);

/// The error of a start with overlaps. `overlap` is the deepest, in diameters. If walls have
/// changed their motion, they are the cause.
template <int D>
PhysicalStop overlap_at_start(const Model<D>& model, const RunState<D>& saved, double overlap);

/// The error of a change that puts a fixture, by its number in the model, where a particle is.
template <int D>
PhysicalStop fixture_in_particle(const Model<D>& model, std::size_t fixture, std::uint32_t particle,
                                 double time);

}  // namespace clatter
