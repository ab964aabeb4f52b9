#pragma once

#include <cstdint>

#include "engine/vec.h"

namespace clatter {

/// Free flight of a particle: a parabola through `r` at `time`, under the common gravity.
template <int D>
struct Flight {
  Vec<D> r = Vec<D>::Zero();  ///< centre at `time`; may be in another periodic image
  Vec<D> v = Vec<D>::Zero();  ///< velocity at `time`
  double time = 0.0;          ///< on the simulation's moving base
  std::uint32_t number = 0;  ///< physical events that the particle had before; predictions made for
                             ///< an earlier flight are stale

  /// The centre at a later time.
  Vec<D> at(double later, const Vec<D>& gravity) const {
    const double dt = later - time;
    return r + (v + gravity * (0.5 * dt)) * dt;
  }
  /// The velocity at a later time.
  Vec<D> velocity_at(double later, const Vec<D>& gravity) const {
    return v + gravity * (later - time);
  }
};

/// Free flight of a piston along its axis, between two of its hits.
struct PistonFlight {
  double place = 0.0;         ///< of its middle at `time`
  double velocity = 0.0;      ///< at `time`
  double acceleration = 0.0;  ///< constant
  double time = 0.0;          ///< on the moving base

  /// The middle at a later time.
  double at(double later) const {
    const double dt = later - time;
    return place + (velocity + acceleration * (0.5 * dt)) * dt;
  }
  /// The velocity at a later time.
  double velocity_at(double later) const { return velocity + acceleration * (later - time); }
};

}  // namespace clatter
