#pragma once

#include <cstdint>

#include "engine/dynamics/long_time.h"

namespace clatter {

/// Simulation times at equal intervals: of kicks, samples and frames. An interval that is the
/// double next to a decimal number means this number: 3 intervals of 0.1 are 0.3, and 3 * 0.1 is
/// not.
class RegularTimes {
 public:
  /// The times `start` + k `interval`, k = 0, 1, ...; `interval` >= 0.
  RegularTimes(double start, double interval);
  /// The times that begin at 0.
  explicit RegularTimes(double interval) : RegularTimes(0.0, interval) {}

  /// The time with this number, from 0, however large the number.
  LongTime exactly(std::uint64_t number) const;
  /// The double next to it.
  double of(std::uint64_t number) const { return exactly(number).high; }
  /// The number of the first time at or after `time`, for an interval > 0.
  std::uint64_t first_from(double time) const;
  /// The first time.
  double start() const { return start_; }
  /// The interval.
  double interval() const { return interval_; }

 private:
  double start_, interval_;
  double decimals_;  // a power of ten that makes the interval a whole number; 0: none
};

}  // namespace clatter
