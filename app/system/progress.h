#pragma once

#include <chrono>
#include <string>

namespace clatter {

/// Form of the progress. Auto shows a bar on a terminal, and a line every few seconds elsewhere.
/// Json prints a JSON line every few seconds. None prints nothing.
enum class ProgressStyle { Auto, Json, None };

/// A duration as "1:05" or "1:00:05".
std::string spell_seconds(double seconds);

/// Prints the progress of a run and the remaining time to stderr.
class Progress {
 public:
  /// A run from `start` to `end` in simulation time. `doing` names the activity, for example
  /// "measuring".
  Progress(ProgressStyle style, std::string doing, double start, double end);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets a new end of the run and a new name of the activity.
  void expect(double end, std::string doing);
  /// Sets the current simulation time, and prints the progress if a new line is due.
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
