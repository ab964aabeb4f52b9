#include "app/runs/frame_times.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter {

namespace {

// A stretch of simulation time from `time` on, at whose begin the factor is `factor`. It changes by
// `slope` per time.
struct Stretch {
  double time, factor, slope;

  double factor_at(double t) const {
    return slope == 0.0 ? factor : factor + slope * (t - time);
  }
  // Integral of 1/factor from `time` to `t`. log1p is exact for a small change of the factor.
  double integral(double t) const {
    const double change = slope * (t - time) / factor;
    return slope == 0.0 ? (t - time) / factor : std::log1p(change) / slope;
  }
  // The time at which the integral has a value.
  double time_at(double value) const {
    return time + (slope == 0.0 ? value * factor : factor * std::expm1(slope * value) / slope);
  }
};

// The stretches from a time on. The factor is constant before the first key and after the last.
std::vector<Stretch> stretches_from(double from, const std::vector<PaceKey>& pace) {
  if (pace.empty()) return {{from, 1.0, 0.0}};
  std::vector<Stretch> stretches = {{0.0, pace.front().factor, 0.0}};
  for (std::size_t k = 0; k + 1 < pace.size(); ++k) {
    const PaceKey &a = pace[k], &b = pace[k + 1];
    stretches.push_back({a.time, a.factor, (b.factor - a.factor) / (b.time - a.time)});
  }
  stretches.push_back({pace.back().time, pace.back().factor, 0.0});
  // The last stretch that begins before `from` begins there.
  auto first = std::ranges::upper_bound(stretches, from, {}, &Stretch::time);
  first = std::max(first, stretches.begin() + 1) - 1;
  *first = {from, first->factor_at(from), first->slope};
  stretches.erase(stretches.begin(), first);
  return stretches;
}

double end_of(const std::vector<Stretch>& stretches, std::size_t k) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  return k + 1 < stretches.size() ? stretches[k + 1].time : kNever;
}

}  // namespace

double FrameTimes::of(long frame) const {
  if (pace.empty()) return from + static_cast<double>(frame) * (speed / fps);
  double left = static_cast<double>(frame) * (speed / fps);  // integral of 1/factor still to come
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
