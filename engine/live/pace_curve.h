#pragma once

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

}  // namespace clatter
