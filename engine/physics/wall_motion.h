#pragma once

namespace clatter {

/// How a wall moves along its normal (theory 4.3).
enum class WallPath {
  Sawtooth,    ///< inwards at constant speed, jumping back at the end of each period
  Sinusoidal,  ///< harmonically about its resting place
};

/// The periodic motion of a wall; lengths are displacements from its resting place into the box.
struct WallMotion {
  WallPath path = WallPath::Sawtooth;
  double stroke = 0.0;     ///< length between the wall's extreme places, >= 0; 0 keeps it at rest
  double frequency = 0.0;  ///< periods per time, >= 0; 0 keeps it at rest
  double phase = 0.0;      ///< periods done at time 0 of the engine's moving base, in [0,1)

  friend bool operator==(const WallMotion&, const WallMotion&) = default;
};

/// Place and motion of a wall at an instant, along its normal into the box.
struct WallState {
  double displacement = 0.0;  ///< from the resting place
  double velocity = 0.0;
  double acceleration = 0.0;  ///< without the saw-tooth's jumps
};

/// The wall at a time on the moving base (theory 4.3): the saw-tooth lies at stroke frac(x), the
/// sinusoidal wall at (stroke/2) sin(2 pi x), x = frequency time + phase.
WallState wall_state(const WallMotion& motion, double time);

/// The largest displacement of the wall: how far it reaches into the box.
double innermost_travel(const WallMotion& motion);

/// First time >= `start` at which a particle meets the moving wall, or kNever. Its touching point
/// lies distance + speed t + acceleration t^2/2 inwards of the wall's resting place, t = time -
/// start.
///
/// A particle that touches the wall at `start` (or lies behind it by rounding) hits it at once if
/// it approaches faster than the rounding of the speeds, or if it neither approaches nor recedes
/// and the accelerations press the two together; otherwise its next contact is sought, which is
/// later than `start`. The saw-tooth's jump back meets nothing.
double moving_wall_contact(const WallMotion& motion, double start, double distance, double speed,
                           double acceleration);

}  // namespace clatter
