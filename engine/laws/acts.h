#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "engine/vec.h"

namespace clatter {

/// A change of velocities at one time, of one particle or of the particles whose centres are in a
/// region. It has one of `scale`, `add` and `set`. Positions and spins remain.
struct Nudge {
  std::optional<int> particle = {};   ///< number of the particle; absent: those of the region
  std::optional<VecX> centre = {};    ///< [D] centre of the region, a disk or a ball, in the box
  std::optional<double> radius = {};  ///< of the region, > 0; across periodic sides as well
  std::optional<double> scale = {};   ///< factor >= 0 of velocities relative to the region's mean
  std::optional<VecX> add = {};       ///< [D] velocity that is added
  std::optional<VecX> set = {};       ///< [D] new velocity

  bool operator==(const Nudge&) const = default;
};

/// Particles that enter the gas at one time, with their centres at random places in a region. They
/// have Gaussian velocities and no spin.
struct Puff {
  int count = 1;                      ///< number of particles, >= 1
  VecX centre = {};                   ///< [D] centre of the region, a disk or a ball, in the box
  double radius = 1.0;                ///< of the region, > 0; across periodic sides as well
  double temperature = 1.0;           ///< m times the variance of each velocity component, >= 0
  std::optional<VecX> velocity = {};  ///< [D] mean velocity; absent: 0
  std::string species = {};           ///< name of their species in a mixture; empty: its first

  bool operator==(const Puff&) const = default;
};

/// A stroke of the piston, the right wall: its rest position moves at constant velocity from
/// `start` to `end`, and is at rest before and after. Lengths are displacements from the end of the
/// box, >= 0.
struct PistonStroke {
  double from = 0.0;
  double to = 0.0;
  double start = 0.0;  ///< simulation time, or time on the moving base
  double end = 0.0;    ///< the same, > start

  /// Velocity of the moving wall along its normal into the box.
  double velocity() const { return (to - from) / (end - start); }
  /// Whether the wall moves at a time.
  bool moves_at(double time) const { return time >= start && time < end; }
  /// Displacement of the rest position into the box at a time. At rest it is exactly `from` or
  /// `to`.
  double travel(double time) const {
    if (time >= end) return to;
    return time > start ? from + velocity() * (time - start) : from;
  }
  /// Largest displacement.
  double innermost() const { return std::max(from, to); }
};

}  // namespace clatter
