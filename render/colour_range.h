#pragma once

#include <string>
#include <vector>

#include "engine/scene/view.h"

namespace clatter {

/// The 98th percentile of the magnitudes of `values`, which ignores a few outliers. Non-finite
/// values are skipped. Returns 0 without finite values.
double robust_extent(std::vector<double> values);

/// The smallest round number at or above `value` > 0: 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of
/// ten. `value` is first clamped to ColourRange::kLeastWidth..kLargestEnd.
double round_up(double value);

/// The largest round number at or below `value` > 0: 1, 2 or 5 times a power of ten.
double round_down(double value);

/// The next end of an automatic colour range for values of this robust extent: `end`, or a round
/// one if the extent is outside 0.5..1.05 times the end. An end of 0 is none yet, and an extent of
/// 0 has no data.
double steady_end(double end, double extent);

/// The end of an automatic colour range. Hysteresis and round steps keep the meaning of a colour
/// constant over most of a film.
class SteadyExtent {
 public:
  /// The steady_end() for values of this robust extent; 1 before the first extent above 0. With
  /// `hold` it stays fixed after the first extent above 0.
  double follow(double extent, bool hold = false);
  /// True if the end is fixed while `hold` is set.
  bool held() const { return held_; }

 private:
  double current_ = 0.0;  ///< 0: no extent yet
  bool held_ = false;
};

/// About `count` round values in [low, high], at least two, in rising order. If the range has no
/// two round values, returns {low, high}. Requires high - low > 0, finite and not subnormal.
std::vector<double> round_ticks(double low, double high, int count);

/// The text of a tick value, with the digits that a spacing of `step` needs.
std::string tick_text(double value, double step);

}  // namespace clatter
