#include "app/measure/accuracy_goal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "app/results/result_json.h"
#include "engine/error.h"
#include "engine/whole_number.h"

namespace clatter {

std::optional<double> share_in(std::string_view text) {
  const bool percent = text.ends_with('%');
  if (percent) text.remove_suffix(1);
  const std::optional<double> number = real_number(text);
  if (!number) return std::nullopt;
  const double share = percent ? 0.01 * *number : *number;
  return share > 0.0 && share < 1.0 ? std::optional(share) : std::nullopt;
}

Estimate estimate_for(const AccuracyGoal& goal, const Measured& measured) {
  std::string names;
  for (const auto& [name, estimate] : estimates_of(measured)) {
    if (name == goal.of) return estimate;
    names += (names.empty() ? "" : ", ") + name;
  }
  throw UserError({"--accuracy-of", 0, 0}, "the result of this scene has no mean '" + goal.of + "'",
                  "choose one of " + names);
}

double relative_error(const Estimate& estimate) {
  if (estimate.mean == 0.0) return std::numeric_limits<double>::infinity();
  return estimate.cautious_error() / std::fabs(estimate.mean);
}

// The measured time at which the error reaches the goal if it falls with the square root of time.
static double needed_time(const AccuracyGoal& goal, const Measured& measured) {
  const double excess = relative_error(estimate_for(goal, measured)) / goal.relative;
  return measured.duration * excess * excess;
}

static std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

// The time of the next test of the error. The intervals grow by about one sixteenth from test to
// test.
template <int D>
static double look_from(const Measurement<D>& measurement, double from) {
  double windows = 256.0;
  const auto time = [&] { return measurement.averages_start() + windows * measurement.window(); };
  while (time() < from) windows += std::floor(windows / 16.0);
  return time();
}

template <int D>
void run_to_goal(const AccuracyGoal& goal, Run<D>& run, const Measurement<D>& measurement,
                 double end, Progress& progress) {
  // A checkpoint may have the time of a test that has not been done yet.
  double look = look_from(measurement, run.simulation().time());
  while (run.until(std::min(end, look), progress) && look < end) {
    const Measured measured = measurement.means();
    const double error = relative_error(estimate_for(goal, measured));
    if (error <= goal.relative) return;
    progress.expect(std::min(end, measurement.averages_start() + needed_time(goal, measured)),
                    "measuring, " + goal.of + " within " + percent(error));
    look = look_from(measurement, std::nextafter(look, end));
  }
}

template void run_to_goal(const AccuracyGoal&, Run<2>&, const Measurement<2>&, double, Progress&);
template void run_to_goal(const AccuracyGoal&, Run<3>&, const Measurement<3>&, double, Progress&);

void note_accuracy(const AccuracyGoal& goal, const Measured& measured) {
  if (!(measured.duration > 0.0)) return;
  const Estimate estimate = estimate_for(goal, measured);
  const double error = relative_error(estimate);
  std::fprintf(stderr, "note: %s = %.6g, relative error %s after %g time units", goal.of.c_str(),
               estimate.mean, percent(error).c_str(), measured.duration);
  if (error > goal.relative) {
    std::fprintf(stderr, "; for %s, give about --until %.2g", percent(goal.relative).c_str(),
                 measured.burn_in + needed_time(goal, measured));
  }
  std::fputs("\n", stderr);
}

void warn_of_drift(const AccuracyGoal& goal, const Measured& measured) {
  constexpr double kMaxErrors = 3.0;
  const auto warn = [](const std::string& name, const Estimate& estimate) {
    if (!(std::fabs(estimate.drift) > kMaxErrors)) return;
    std::fprintf(stderr,
                 "note: %s is not stationary: in the second half of the measured time it is %s by "
                 "%.2g combined errors; a longer measure.burn_in may help\n",
                 name.c_str(), estimate.drift > 0.0 ? "higher" : "lower",
                 std::fabs(estimate.drift));
  };
  warn("temperature", measured.temperature);
  if (goal.asked_for() && goal.of != "temperature") warn(goal.of, estimate_for(goal, measured));
}

}  // namespace clatter
