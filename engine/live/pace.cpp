#include "engine/live/pace.h"

#include <algorithm>
#include <utility>

namespace clatter {

void Pace::set_speed(double speed) {
  speed_ = speed;
  restart();
}

void Pace::set_factors(const std::vector<PaceKey>& keys) {
  std::vector<PaceKey> both;
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
    if (key->time > 0.0) both.push_back({-key->time, key->factor});
  }
  both.insert(both.end(), keys.begin(), keys.end());
  curve_ = PaceCurve(std::move(both));
}

void Pace::restart() {
  running_ = false;
  held_ = 1.0;
}

Pace::Goal Pace::next(Clock::time_point now, double time) {
  if (!running_) {
    running_ = true;
    due_ = observed_since_ = now;
    goal_ = time_then_ = time;
  }
  observe(now, time);
  due_ += frame_;
  if (due_ < now || time < goal_) {
    due_ = std::max(due_, now);
    goal_ = time;
  }
  goal_ = curve_.time_after(goal_, speed_ * std::chrono::duration<double>(frame_).count());
  return {due_, goal_};
}

void Pace::observe(Clock::time_point now, double time) {
  constexpr double kLong = 0.5;  // seconds
  const double seconds = std::chrono::duration<double>(now - observed_since_).count();
  if (seconds < kLong) return;
  // Without one frame's time: a late start of the last frame does not mean that the engine is slow.
  const double frame = std::chrono::duration<double>(frame_).count();
  const double played = curve_.playing_time(time_then_, time) / speed_;
  held_ = std::min(1.0, played / std::max(kLong, seconds - frame));
  observed_since_ = now;
  time_then_ = time;
}

}  // namespace clatter
