#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/live/click_recorder.h"

// Sound in the window. While the user listens, the worker adds a PlayedStretch to its frames for
// each stretch that a gas plays forwards: its times, its speed and its clicks. Steps, jumps and the
// way backwards make no stretch, so they are silent. A frame has the last 32 stretches, so the
// window may miss frames. A stretch has at most 2048 clicks. Of more, ClickRecorder keeps every
// second one with twice its energy, every fourth, and so on. LiveSound renders stretches one after
// the other. A loudspeaker that has run dry gets 0.1 s of silence first, and at most 0.3 s of
// samples wait. OpenAL mixes in a thread of its own; all calls to it are made by the window's
// thread. The cost for the engine is 1 to 2 % of its rate.

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

/// The last stretches that a gas played under Listen, at most kMostStretches.
class PlayedStretches {
 public:
  /// Begins or ends to keep stretches, without the earlier ones.
  void listen(bool on) {
    listens_ = on;
    last_.clear();
  }
  /// Whether stretches are kept.
  bool listens() const { return listens_; }
  /// Later stretches have other laws.
  void change_laws() { ++laws_; }
  /// Adds a stretch, and sets its number and its laws.
  void add(PlayedStretch stretch) {
    stretch.number = ++number_;
    stretch.laws = laws_;
    if (last_.size() == kMostStretches) last_.erase(last_.begin());
    last_.push_back(std::make_shared<const PlayedStretch>(std::move(stretch)));
  }
  /// The stretches in order.
  const std::vector<std::shared_ptr<const PlayedStretch>>& last() const { return last_; }

 private:
  bool listens_ = false;
  std::uint64_t number_ = 0;  // of the last stretch
  std::uint64_t laws_ = 0;    // see PlayedStretch
  std::vector<std::shared_ptr<const PlayedStretch>> last_;
};

}  // namespace clatter
