#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/publish/click_recorder.h"

namespace clatter {

/// Largest number of clicks in a stretch. More are thinned out, see ClickRecorder.
inline constexpr std::size_t kMostClicks = 2048;
/// Largest number of stretches in a frame.
inline constexpr std::size_t kMostStretches = 32;

/// A stretch of the run that was played forwards, about as long as a frame, and its collisions.
struct PlayedStretch {
  std::uint64_t number = 0;  ///< 1 for the first stretch
  double from = 0.0;         ///< simulation times
  double to = 0.0;
  double speed = 1.0;      ///< simulation time per second that the engine reaches, > 0
  std::uint64_t laws = 0;  ///< number of scenes and of laws that the user has set so far
  std::vector<Click> clicks = {};
};

}  // namespace clatter
