#pragma once

#include <chrono>

namespace clatter {

/// Paces simulation time against real time: says when each frame is due and of which simulation
/// time it is. What the engine cannot hold is given up, not made up for.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// A frame: the real time at which it is due and the simulation time that it shows.
  struct Goal {
    Clock::time_point due;
    double time;
  };

  explicit Pace(double frames_per_second)
      : frame_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1.0 / frames_per_second))) {}

  /// Simulation time per second, > 0.
  void set_speed(double speed);
  /// As set_speed() said; 1 before.
  double speed() const { return speed_; }
  /// The frame after the one before, when it is `now` and simulation time has got to `time`.
  Goal next(Clock::time_point now, double time);
  /// After a halt: nothing is due.
  void restart();

  /// What share of the speed was held over the last half second; at most 1.
  double held() const { return held_; }

 private:
  void observe(Clock::time_point now, double time);

  Clock::duration frame_;
  double speed_ = 1.0;
  bool running_ = false;
  Clock::time_point due_;
  double goal_ = 0.0;
  Clock::time_point observed_since_;
  double time_then_ = 0.0;
  double held_ = 1.0;
};

}  // namespace clatter
