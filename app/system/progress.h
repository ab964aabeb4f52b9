#pragma once

#include <chrono>
#include <string>

namespace clatter {

/// How progress is shown: a bar on a terminal and a line every few seconds elsewhere (Auto), a JSON
/// line every few seconds, or not at all.
enum class ProgressStyle { Auto, Json, None };

/// Tells on stderr how far a run has come and how long it will take.
class Progress {
 public:
  /// A run from `start` to `end` in simulation time; `doing` names it ("measuring").
  Progress(ProgressStyle style, std::string doing, double start, double end);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The run is now expected to end at `end`; `doing` names it from now on.
  void expect(double end, std::string doing);
  /// The run has come to `time`; prints if it is time to.
  void update(double time);

 private:
  using Clock = std::chrono::steady_clock;

  ProgressStyle style_;
  std::string doing_;
  double start_;
  double end_;
  bool terminal_;
  bool bar_shown_ = false;
  Clock::time_point began_;
  Clock::time_point last_shown_;
};

}  // namespace clatter
