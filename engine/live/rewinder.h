#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/live/watched_run.h"

namespace clatter {

/// Plays a run backwards. It replays stretches of the run forwards, keeps their frames, and returns
/// them in reverse order. While the frames of one stretch are shown, it makes those of the stretch
/// before. The run is elsewhere in its past meanwhile.
class Rewinder {
 public:
  /// Frames of `run` before its present time, at intervals > 0 of simulation time, and one at time
  /// 0. The run must outlive this object.
  Rewinder(WatchedRun& run, double interval);

  /// Whether there is more to make before frames are taken.
  bool busy() const { return count_ > 0 && making_.size() < count_; }
  /// Works for some milliseconds, until a frame is made, or until a request to pause. Throws
  /// PhysicalStop.
  void work(const StopRequest& pause);
  /// Whether the frame nearest to a simulation time is earlier than the last one taken.
  bool due(double time) const { return number_at(time) >= static_cast<double>(next_); }
  /// The frame nearest to a simulation time, or the earliest one that is made. Absent: work() must
  /// make one. Requires due().
  std::optional<Frame> take(double time);

 private:
  double time_of(std::uint64_t number) const;
  double number_at(double time) const;
  void begin_stretch();

  WatchedRun& run_;
  double start_;
  double interval_;
  std::uint64_t last_;        // number of the frame at time 0; frame 0 is at the start
  std::vector<Frame> ready_;  // in order of time
  std::uint64_t next_ = 1;    // number of the last frame of ready_, the next to be taken
  std::vector<Frame> making_;
  std::uint64_t first_ = 1;  // number of the last frame of the stretch that is made
  std::size_t count_ = 0;    // frames of this stretch; 0: all frames are made
  std::size_t longest_ = 4;  // frames of the next stretch, if there are so many
  bool there_ = false;       // the run has gone back to this stretch
};

}  // namespace clatter
