#pragma once

#include <algorithm>

namespace clatter {

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
