#pragma once

#include <string>
#include <utility>

#include "app/runs/run.h"
#include "app/system/progress.h"
#include "engine/measure/measurement.h"

namespace clatter {

/// How precisely a measurement is to know one of its means.
struct AccuracyGoal {
  double relative = 0.0;           ///< standard error over mean; 0: not asked for
  std::string of = "temperature";  ///< dotted name of the mean in the result file

  /// Whether a run is to end once it is that precise.
  bool asked_for() const { return relative > 0.0; }
};

/// The estimate that the goal is about. Throws UserError where the result will have none.
Estimate estimate_for(const AccuracyGoal& goal, const Measured& measured);

/// The mean's standard error over its size, the error as cautious_error() has it: where blocks
/// are still too short to show all correlations, it is not taken for less than it may be. Infinite
/// where the mean is 0.
double relative_error(const Estimate& estimate);

/// Runs until the goal is reached, or to `end` at the latest. Looks at the end of certain windows
/// of the measurement, the 256th the first, so that where the run ends depends on nothing but
/// scene, seed and `end`.
template <int D>
void run_to_goal(const AccuracyGoal& goal, Run<D>& run, const Measurement<D>& measurement,
                 double end, Progress& progress);

/// Says on stderr how precise the mean is, and if that is not enough, how long a run would be.
void tell_accuracy(const AccuracyGoal& goal, const Measured& measured);

/// Says on stderr if the temperature, or what the goal is about, differs between the halves of the
/// measured time by more than 3 combined errors.
void warn_of_drift(const AccuracyGoal& goal, const Measured& measured);

}  // namespace clatter
