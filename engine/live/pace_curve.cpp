#include "engine/live/pace_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace clatter
