#pragma once

#include <limits>

namespace clatter {

/// Limits of values. Squares of speeds, temperatures and times between collisions must not overflow
/// or underflow. Positions in the largest box have a rounding error of 1e-10 diameters, and phases
/// of walls have the same precision in periods. The smallest inertia limits the ratio of spins to
/// speeds.
inline constexpr double kMaxCount = std::numeric_limits<int>::max();
inline constexpr double kMaxSpeed = 1e15;
inline constexpr double kMaxTemperature = 1e30;
inline constexpr double kMaxAcceleration = 1e15;
inline constexpr double kMaxLength = 1e6;
inline constexpr double kMaxFrequency = 1e15;
inline constexpr double kMaxPhase = 1e6;
inline constexpr double kMinInertia = 1e-9;
/// Limits of the times and the speed of [view]: the clock can count their multiples.
inline constexpr double kMinViewTime = 1e-30;
inline constexpr double kMaxViewTime = 1e30;
/// Maximum number of snapshots in an averaging window.
inline constexpr double kMaxWindowSamples = 1e6;
/// Limits of the width of pictures, and of the camera's distance from the origin: a thousandth of a
/// particle, and a thousand of the largest boxes.
inline constexpr double kMinCameraWidth = 1e-3;
inline constexpr double kMaxCameraWidth = 1e9;
/// Limits of the angles of the camera, in degrees. Paths may turn several times.
inline constexpr double kMaxAzimuth = 36000.0;
inline constexpr double kMaxElevation = 90.0;
inline constexpr double kMaxViewAngle = 120.0;
inline constexpr double kMaxVolume = 1e3;
/// Maximum factor of velocities in a nudge.
inline constexpr double kMaxScale = 1e3;
/// A wall that adds energy (theory 4.1) has a restitution above 1.
inline constexpr double kMaxWallRestitution = 10.0;

}  // namespace clatter
