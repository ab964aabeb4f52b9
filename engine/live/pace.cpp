#include "engine/live/pace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clatter {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// A stretch of simulation time, with the factors at its begin and at its end. The factor changes at
// a constant rate in the film, so that its square is linear in simulation time. Square roots are
// exact to the last bit on all processors, logarithms are not.
struct Stretch {
  double begin, end;
  double factor, last_factor;

  double factor_at(double time) const {
    if (end == kUnbounded) return factor;
    const double share = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
    return std::sqrt((1.0 - share) * factor * factor + share * last_factor * last_factor);
  }
  // Integral of 1/factor from the begin to a time.
  double integral(double time) const { return 2.0 * (time - begin) / (factor + factor_at(time)); }
  // The time at which the integral has a value.
  double time_at(double value) const {
    if (end == kUnbounded) return begin + factor * value;
    const double squares = last_factor * last_factor - factor * factor;
    return std::min(begin + value * (factor + 0.25 * squares / (end - begin) * value), end);
  }
};

// The stretches from a time on.
std::vector<Stretch> stretches_from(double from, const std::vector<PaceKey>& keys) {
  if (keys.empty()) return {{from, kUnbounded, 1.0, 1.0}};
  std::vector<Stretch> stretches;
  PaceKey before{std::min(0.0, from), keys.front().factor};
  for (const PaceKey& key : keys) {
    if (key.time > from) {
      const Stretch whole{before.time, key.time, before.factor, key.factor};
      const double begin = std::max(from, before.time);
      stretches.push_back({begin, key.time, whole.factor_at(begin), key.factor});
    }
    before = key;
  }
  stretches.push_back({std::max(from, before.time), kUnbounded, before.factor, before.factor});
  return stretches;
}

}  // namespace

double PaceCurve::factor_at(double time) const {
  return stretches_from(time, keys_).front().factor;
}

double PaceCurve::largest_factor() const {
  double factor = keys_.empty() ? 1.0 : 0.0;
  for (const PaceKey& key : keys_) factor = std::max(factor, key.factor);
  return factor;
}

double PaceCurve::playing_time(double from, double to) const {
  double sum = 0.0;
  for (const Stretch& stretch : stretches_from(from, keys_)) {
    sum += stretch.integral(std::min(to, stretch.end));
    if (to <= stretch.end) break;
  }
  return sum;
}

double PaceCurve::time_after(double from, double playing_time) const {
  if (keys_.empty()) return from + playing_time;
  const std::vector<Stretch> stretches = stretches_from(from, keys_);
  for (std::size_t k = 0; k + 1 < stretches.size(); ++k) {
    const double whole = stretches[k].integral(stretches[k].end);
    if (playing_time <= whole) return stretches[k].time_at(playing_time);
    playing_time -= whole;
  }
  return stretches.back().time_at(playing_time);
}

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
