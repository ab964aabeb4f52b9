#pragma once

namespace clatter {

/// The simulation times 0, `every`, 2 `every` and so on. They are the doubles next to the decimal
/// numbers: 3 intervals of 0.1 are 0.3, and 3 * 0.1 is not.
class RegularTimes {
 public:
  /// `every` > 0 is the interval in simulation time.
  explicit RegularTimes(double every);

  /// The time with this number, from 0.
  double of(long number) const;
  /// The number of the first time at or after `time`.
  long first_from(double time) const;

 private:
  double every_;
  double decimals_;  // a power of ten that makes `every_` a whole number; 0: none
};

}  // namespace clatter
