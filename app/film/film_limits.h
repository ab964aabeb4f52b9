#pragma once

namespace clatter {

/// Largest number of frames of a film.
inline constexpr long kMostFrames = 10'000'000;
/// Most samples per pixel, along each axis.
inline constexpr int kMostSamples = 4;
/// Most frames per second of film.
inline constexpr double kMostFps = 1000.0;
/// Longest side of a picture, in pixels.
inline constexpr int kLongestSide = 16384;

}  // namespace clatter
