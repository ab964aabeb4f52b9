#include "app/runs/frame_times.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter {

namespace {

// A stretch of simulation time from `time` on, at whose begin the factor is `factor`. The factor
// changes at a constant rate in the film, so that its square is linear in simulation time:
// d(factor^2)/dt = 2 rate. Roots are exact to the last bit on all processors, logarithms are not.
struct Stretch {
  double time, factor, rate;

  double factor_at(double t) const {
    return rate == 0.0 ? factor : std::sqrt(factor * factor + 2.0 * rate * (t - time));
  }
  // Integral of 1/factor from `time` to `t`.
  double integral(double t) const { return 2.0 * (t - time) / (factor + factor_at(t)); }
  // The time at which the integral has a value.
  double time_at(double value) const { return time + value * (factor + 0.5 * rate * value); }
};

// The stretches from a time on. The factor is constant before the first key and after the last.
std::vector<Stretch> stretches_from(double from, const std::vector<PaceKey>& pace) {
  if (pace.empty()) return {{from, 1.0, 0.0}};
  std::vector<Stretch> stretches = {{0.0, pace.front().factor, 0.0}};
  for (std::size_t k = 0; k + 1 < pace.size(); ++k) {
    const PaceKey &a = pace[k], &b = pace[k + 1];
    const double squares = b.factor * b.factor - a.factor * a.factor;
    stretches.push_back({a.time, a.factor, 0.5 * squares / (b.time - a.time)});
  }
  stretches.push_back({pace.back().time, pace.back().factor, 0.0});
  // The last stretch that begins before `from` begins there.
  auto first = std::ranges::upper_bound(stretches, from, {}, &Stretch::time);
  first = std::max(first, stretches.begin() + 1) - 1;
  *first = {from, first->factor_at(from), first->rate};
  stretches.erase(stretches.begin(), first);
  return stretches;
}

double end_of(const std::vector<Stretch>& stretches, std::size_t k) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  return k + 1 < stretches.size() ? stretches[k + 1].time : kNever;
}

}  // namespace

double FrameTimes::of(long frame) const {
  return time_at(static_cast<double>(frame), speed / fps);
}

double FrameTimes::time_after(double seconds) const {
  return time_at(seconds, speed);
}

double FrameTimes::time_at(double count, double length) const {
  double left = count * length;  // integral of 1/factor still to come
  if (pace.empty()) return from + left;
  const std::vector<Stretch> stretches = stretches_from(from, pace);
  for (std::size_t k = 0;; ++k) {
    const double end = end_of(stretches, k);
    const double whole = std::isinf(end) ? end : stretches[k].integral(end);
    if (left <= whole) return std::min(stretches[k].time_at(left), end);
    left -= whole;
  }
}

double FrameTimes::seconds_at(double time) const {
  const std::vector<Stretch> stretches = stretches_from(from, pace);
  double sum = 0.0;
  for (std::size_t k = 0; k < stretches.size() && (k == 0 || stretches[k].time < time); ++k) {
    sum += stretches[k].integral(std::min(time, end_of(stretches, k)));
  }
  return sum / speed;
}

double FrameTimes::speed_at(double time) const {
  return speed * stretches_from(time, pace).front().factor;
}

double FrameTimes::largest_speed() const {
  double factor = pace.empty() ? 1.0 : 0.0;
  for (const PaceKey& key : pace) factor = std::max(factor, key.factor);
  return speed * factor;
}

}  // namespace clatter
