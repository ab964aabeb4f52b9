#pragma once

#include <chrono>
#include <vector>

#include "engine/scene/view.h"

namespace clatter {

/// The factor of the playback speed as a function of simulation time, see PaceKey. It is constant
/// before the first key and after the last one.
class PaceCurve {
 public:
  /// The curve through keys in order of time. Without keys the factor is 1.
  explicit PaceCurve(std::vector<PaceKey> keys = {}) : keys_(std::move(keys)) {}

  /// The factor at a time.
  double factor_at(double time) const;
  /// The largest factor of any time.
  double largest_factor() const;
  /// Integral of 1/factor between two times, from <= to: the playing time at speed 1.
  double playing_time(double from, double to) const;
  /// The time at which the playing time since `from` has a value >= 0.
  double time_after(double from, double playing_time) const;

 private:
  std::vector<PaceKey> keys_;
};

/// Couples simulation time to real time: gives for each frame the real time at which it is due and
/// its simulation time. A delay is dropped and not caught up later. A gas that plays backwards has
/// negative times, which increase.
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

  /// Sets the real time of a frame, for a display whose pictures come at varying times.
  void set_frame(Clock::duration frame) { frame_ = frame; }
  /// Sets the simulation time per second, > 0.
  void set_speed(double speed);
  /// The speed of set_speed(), initially 1.
  double speed() const { return speed_; }
  /// Sets the factors of the speed: keys in order of time, >= 0; empty: 1. They hold in both
  /// directions.
  void set_factors(const std::vector<PaceKey>& keys);
  /// The speed at a simulation time, with its factor.
  double speed_at(double time) const { return speed_ * curve_.factor_at(time); }
  /// The next frame, at the real time `now` and the simulation time `time`.
  Goal next(Clock::time_point now, double time);
  /// To be called after a halt: the next frame starts a new sequence.
  void restart();

  /// Share of the speed that was reached over the last half second; at most 1.
  double held() const { return held_; }

 private:
  void observe(Clock::time_point now, double time);

  Clock::duration frame_;
  double speed_ = 1.0;
  PaceCurve curve_;  // of negative times too
  bool running_ = false;
  Clock::time_point due_;
  double goal_ = 0.0;
  Clock::time_point observed_since_;
  double time_then_ = 0.0;
  double held_ = 1.0;
};

}  // namespace clatter
