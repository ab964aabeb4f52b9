#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/physics/random.h"
#include "engine/physics/wall_motion.h"

namespace clatter::testing {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A particle in front of a wall: the arguments of moving_wall_contact.
struct WallCase {
  WallMotion motion;
  double start = 0.0;
  double distance = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;

  /// The contact time under test.
  double contact() const {
    return moving_wall_contact(motion, start, distance, speed, acceleration);
  }
  /// Height and speed of the particle at a time t after the start.
  double height(double t) const { return distance + speed * t + 0.5 * acceleration * t * t; }
  double velocity(double t) const { return speed + acceleration * t; }
  /// The largest speed and acceleration of the wall.
  double peak_speed() const {
    const double speed = motion.stroke * motion.frequency;
    return motion.path == WallPath::Sawtooth ? speed : std::numbers::pi * speed;
  }
  double peak_acceleration() const {
    return motion.path == WallPath::Sawtooth
               ? 0.0
               : 2.0 * std::numbers::pi * motion.frequency * peak_speed();
  }
  /// Initial overlap with the wall, from rounding errors of the previous flight.
  double overlap() const {
    return std::max(0.0, wall_state(motion, start).displacement - distance);
  }
  /// Speeds and lengths up to the time t after the start, on the moving base. Their rounding errors
  /// give the unit of the error.
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

/// The errors of contact times over many cases: worst values in units of the rounding error.
struct Verdict {
  int contacts = 0, at_once = 0, never = 0, early = 0, missed = 0;
  double residual = 0.0, overlap = 0.0, recession = 0.0;

  /// Tests the contact time of a case: the particle touches the wall there, and not earlier. A scan
  /// of the gap over the periods of the wall is the reference.
  void add(const WallCase& c, double time);
  /// Checks that no error exceeds ten rounding errors.
  void check() const;
};

/// -1 or 1.
double sign(Random& random);

/// 10^x with x uniform.
double log_uniform(Random& random, double from, double to);

/// A random particle in front of a wall, over wide ranges. Stroke and frequency set the units.
WallCase random_case(WallPath path, Random& random);

/// The particle after its collision with the wall (theory 4.2).
void reflect_at(WallCase& c, double time, double restitution);

}  // namespace clatter::testing
