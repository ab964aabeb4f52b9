#pragma once

namespace clatter {

/// Motion of a wall along its normal (theory 4.3).
enum class WallPath {
  Sawtooth,    ///< inwards at constant speed, jumping back at the end of each period
  Sinusoidal,  ///< harmonically about its rest position
};

/// The periodic motion of a wall; lengths are displacements from its rest position into the box.
struct WallMotion {
  WallPath path = WallPath::Sawtooth;
  double stroke = 0.0;     ///< distance of the wall's extreme positions, >= 0; 0: at rest
  double frequency = 0.0;  ///< periods per time, >= 0; 0: at rest
  double phase = 0.0;      ///< in periods, at time 0 of the moving base, in [0,1)

  friend bool operator==(const WallMotion&, const WallMotion&) = default;
};

/// Position and motion of a wall at an instant, along its normal into the box.
struct WallState {
  double displacement = 0.0;  ///< from the rest position
  double velocity = 0.0;
  double acceleration = 0.0;  ///< without the saw-tooth's jumps
};

/// The wall at a time on the moving base (theory 4.3). With x = frequency time + phase, the
/// displacement of the saw-tooth is stroke frac(x), and of the sinusoidal wall (stroke/2) sin(2 pi
/// x).
WallState wall_state(const WallMotion& motion, double time);

/// The largest displacement of the wall into the box.
double innermost_travel(const WallMotion& motion);

/// First time >= `start` at which a particle meets the moving wall, or kNever. The distance of its
/// contact point from the wall's rest position, inwards, is distance + speed t + acceleration t^2/2
/// with t = time - start.
/// `rest_velocity` is the velocity of the rest position, constant from `start` on.
///
/// A particle may touch the wall at `start`, or be behind it by rounding. It then hits the wall at
/// once if it approaches faster than the rounding of the speeds. It also does so without relative
/// speed if the accelerations press it against the wall. Otherwise the result is its next contact,
/// later than `start`. The jump back of the saw-tooth hits no particle.
double moving_wall_contact(const WallMotion& motion, double start, double distance, double speed,
                           double acceleration, double rest_velocity = 0.0);

}  // namespace clatter
