#pragma once

#include <limits>

namespace clatter {

/// Limits of laws. Squares of speeds, temperatures and times between collisions must not overflow
/// or underflow. Positions in the largest box have a rounding error of 1e-10 diameters, and phases
/// of walls have the same precision in periods. The smallest inertia limits the ratio of spins to
/// speeds.
inline constexpr double kMaxCount = std::numeric_limits<int>::max();
inline constexpr double kMaxSpeed = 1e15;
inline constexpr double kMaxTemperature = 1e30;
inline constexpr double kMaxAcceleration = 1e15;
/// Largest shear rate of a scene.
inline constexpr double kMaxShearRate = 1e6;
inline constexpr double kMaxLength = 1e6;
inline constexpr double kMaxFrequency = 1e15;
inline constexpr double kMaxPhase = 1e6;
inline constexpr double kMinInertia = 1e-9;
/// Limits of the diameters and masses of a mixture.
inline constexpr double kMinDiameter = 1e-3;
inline constexpr double kMaxDiameter = 1e3;
inline constexpr double kMinMass = 1e-9;
inline constexpr double kMaxMass = 1e9;
/// Maximum number of species: each two of them have a law.
inline constexpr int kMaxSpecies = 100;
/// Maximum factor of velocities in a nudge.
inline constexpr double kMaxScale = 1e3;
/// A wall that adds energy (theory 4.1) has a restitution above 1.
inline constexpr double kMaxWallRestitution = 10.0;

}  // namespace clatter
