#pragma once

#include "engine/dynamics/watchdog.h"
#include "engine/error.h"
#include "engine/laws/model.h"

namespace clatter {

/// How hot a gas is.
struct Heat {
  double temperature = 0.0;  ///< granular temperature
  double speed = 0.0;        ///< root of twice the kinetic energy over the mass of all particles
};

/// The error of a run whose simulation time no longer advances: cause, place, and the setting with
/// which the run would continue. `compressed`: the piston moves in.
template <int D>
PhysicalStop standstill(const Model<D>& model, const Watchdog& watchdog, double time,
                        const Heat& heat, bool compressed);

/// The error of a run whose particles have no room, so that collisions follow each other within
/// the rounding of positions.
template <int D>
PhysicalStop crowding(const Model<D>& model, const Watchdog& watchdog, double time);

/// Speed that particles of a run reach at least, whose fastest particle began with `start_speed`:
/// by walls, a fall across the box or a kick.
template <int D>
double usual_speed(const Model<D>& model, double start_speed);

/// Speed limit of a run whose fastest particle began with `start_speed`. A faster particle shows
/// that walls heat the gas without bound, or that a piston leaves it no room. kNever without a
/// piston if walls do not heat. `piston`: whether the piston has moved.
template <int D>
double fastest_speed(const Model<D>& model, double start_speed, bool piston);

/// The error of a run in which walls make the speeds diverge. `compressed`: the piston moves in.
template <int D>
PhysicalStop divergence(const Model<D>& model, double time, const Heat& heat, bool compressed);

}  // namespace clatter
