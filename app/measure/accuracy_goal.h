#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/runs/run.h"
#include "app/system/progress.h"
#include "engine/measure/measurement.h"

namespace clatter {

/// The share in a text such as 1% or 0.01, between 0 and 1, both excluded. Absent if the text is
/// anything else.
std::optional<double> share_in(std::string_view text);

/// The required precision of a mean.
struct AccuracyGoal {
  double relative = 0.0;           ///< standard error over mean; 0: no goal
  std::string of = "temperature";  ///< dotted name of the mean in the result file

  /// Whether a goal is set.
  bool asked_for() const { return relative > 0.0; }
};

/// The estimate of the goal. Throws UserError if the result has no mean of this name.
Estimate estimate_for(const AccuracyGoal& goal, const Measured& measured);

/// The relative standard error of a mean, with the error of cautious_error(). This error is not too
/// small if the blocks are still shorter than the correlations. Infinite if the mean is 0.
double relative_error(const Estimate& estimate);

/// Runs until the goal is reached, or to `end` at the latest. Tests the error at the ends of
/// certain windows, first of window 256. The end of the run thus depends on scene, seed and `end`
/// only.
template <int D>
void run_to_goal(const AccuracyGoal& goal, Run<D>& run, const Measurement<D>& measurement,
                 double end, Progress& progress);

/// Prints the precision of the mean to stderr. If the goal is missed, also prints the necessary
/// duration.
void note_accuracy(const AccuracyGoal& goal, const Measured& measured);

/// Warns on stderr of a drift. The test compares the two halves of the measured time, for the
/// temperature and for the mean of the goal. The limit is 3 combined standard errors.
void warn_of_drift(const AccuracyGoal& goal, const Measured& measured);

}  // namespace clatter
