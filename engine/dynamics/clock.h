#pragma once

#include "engine/dynamics/long_time.h"

// Time. Event times are kept on a base that moves with the run, so they are as precise at t = 1e9
// as at t = 0. The base moves after a number of physical events. It also moves at each kick of bulk
// driving, and when a particle becomes so fast that times are too coarse for its flight. It never
// moves for a frame or an observer. Periodic actions (samples, windows) are a start and an integer
// count, see Simulation::every.

namespace clatter {

/// Maps between simulation time and the moving base. The engine keeps event times on this base, so
/// that an event at t = 1e9 is as precise as one at t = 0.
class Clock {
 public:
  /// A clock with its base at `start`.
  explicit Clock(double start = 0.0) : base_{start, 0.0} {}
  /// A clock with this base.
  explicit Clock(const LongTime& base) : base_(base) {}

  /// Moves the base by `shift`; event times become smaller by it.
  void advance(double shift);

  /// Simulation time of the base.
  const LongTime& base() const { return base_; }
  /// Simulation time of a time on the base.
  double absolute(double relative) const;
  /// A simulation time on the base; infinite times stay infinite.
  double relative(double absolute) const;
  /// The same for a time with more digits.
  double relative(const LongTime& absolute) const;

  /// Phase at the base, in periods, of a motion with `phase` at simulation time 0: the fractional
  /// part of frequency * base + phase, in [0,1). The product is exact for any number of periods.
  double periods(double frequency, double phase) const;

 private:
  LongTime base_;
};

}  // namespace clatter
