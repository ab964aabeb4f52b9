#pragma once

#include <string>
#include <vector>

#include "engine/scene/view.h"

namespace clatter {

/// The 98th percentile of the magnitudes of `values`, without the few that would drown the rest;
/// what is not finite does not count; 0 where nothing does.
double robust_extent(std::vector<double> values);

/// The next round number at or above `value` > 0: 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten.
/// Values beyond the limits of colour ranges count as these limits.
double round_up(double value);

/// The last round number at or below `value` > 0: 1, 2 or 5 times a power of ten.
double round_down(double value);

/// The end of an automatic colour range. It moves in round steps and only when it must, so that
/// over a film a colour keeps its meaning as long as it can.
class SteadyExtent {
 public:
  /// The end to use for values of this robust extent; `hold` keeps it from moving after the first
  /// extent above 0 that comes with it.
  double follow(double extent, bool hold = false);
  /// Whether it moves no more as long as it is held.
  bool held() const { return held_; }

 private:
  double current_ = 0.0;  ///< 0: nothing seen yet
  bool held_ = false;
};

/// Round values in [low, high], about `count` of them and at least two, in rising order; the two
/// ends where no two round values lie between them. The width of the range is an ordinary number.
std::vector<double> round_ticks(double low, double high, int count);

/// A tick's value, with as many digits as ticks `step` apart need.
std::string tick_text(double value, double step);

}  // namespace clatter
