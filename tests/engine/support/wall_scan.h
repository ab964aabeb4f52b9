#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/physics/random.h"
#include "engine/physics/wall_motion.h"

namespace clatter::testing {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A particle before a wall: the arguments of moving_wall_contact.
struct WallCase {
  WallMotion motion;
  double start = 0.0;
  double distance = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;

  /// What is tested.
  double contact() const {
    return moving_wall_contact(motion, start, distance, speed, acceleration);
  }
  /// Where the particle is a time t after the start, and how fast.
  double height(double t) const { return distance + speed * t + 0.5 * acceleration * t * t; }
  double velocity(double t) const { return speed + acceleration * t; }
  /// The most that the wall has of either.
  double peak_speed() const {
    const double speed = motion.stroke * motion.frequency;
    return motion.path == WallPath::Sawtooth ? speed : std::numbers::pi * speed;
  }
  double peak_acceleration() const {
    return motion.path == WallPath::Sawtooth
               ? 0.0
               : 2.0 * std::numbers::pi * motion.frequency * peak_speed();
  }
  /// By how much the particle starts behind the wall: what rounding left of the flight before.
  double overlap() const {
    return std::max(0.0, wall_state(motion, start).displacement - distance);
  }
  /// The speeds and lengths that occur until t after the start, on the moving base: their rounding
  /// is the error.
  double speeds(double t) const {
    return std::fabs(speed) + std::fabs(acceleration * t) + peak_speed() +
           peak_acceleration() * (std::fabs(start) + t);
  }
  double lengths(double t) const {
    return std::fabs(distance) + motion.stroke +
           (std::fabs(speed) + std::fabs(acceleration * t) + peak_speed()) *
               (std::fabs(start) + t) +
           overlap() / kEpsilon;
  }
};

/// What contact times left to be desired, over many cases; worst values in units of the rounding.
struct Verdict {
  int contacts = 0, at_once = 0, never = 0, early = 0, missed = 0;
  double residual = 0.0, overlap = 0.0, recession = 0.0;

  /// Judges the contact time of a case: the particle touches there, and nowhere before, as a scan
  /// of the gap over the wall's periods tells.
  void add(const WallCase& c, double time);
  /// Checks that no error is more than ten roundings.
  void check() const;
};

/// -1 or 1.
double sign(Random& random);

/// 10^x with x uniform.
double log_uniform(Random& random, double from, double to);

/// A particle before a wall, over wide ranges of what the wall's stroke and frequency leave free.
WallCase random_case(WallPath path, Random& random);

/// Makes it the particle after the wall has hit it (theory 4.2).
void reflect_at(WallCase& c, double time, double restitution);

}  // namespace clatter::testing
