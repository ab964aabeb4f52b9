#pragma once

#include <chrono>
#include <optional>

namespace clatter {

/// Measures simulation time and real time, with one button: start, stop, back to zero.
class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Times since the start.
  struct Reading {
    double simulated = 0.0;  ///< simulation time; negative after a jump into the past
    double seconds = 0.0;    ///< real time
  };

  /// Presses the button at a simulation time and a real time.
  void press(double time, Clock::time_point now);
  /// Sets the stopwatch to zero.
  void clear() { *this = {}; }
  /// Whether it has not been started.
  bool at_zero() const { return !started_; }
  /// Whether it runs.
  bool runs() const { return started_ && !stopped_; }
  /// The times at a simulation time and a real time; zeros before the start.
  Reading read(double time, Clock::time_point now) const;

 private:
  struct Start {
    double time;
    Clock::time_point moment;
  };

  std::optional<Start> started_;
  std::optional<Reading> stopped_;
};

}  // namespace clatter
