#pragma once

#include "engine/laws/limits.h"

namespace clatter {

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
/// Largest widths of polydispersity. A Gaussian of width 1/3 reaches down to 0.
inline constexpr double kMaxUniformWidth = 0.99;
inline constexpr double kMaxGaussianWidth = 0.33;

}  // namespace clatter
