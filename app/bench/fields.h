#pragma once

#include <string>

namespace clatter {

/// Prints what fields cost and how precise they are: for the vibrated scene, CPU time over a bare
/// run, variance of the profile of T at equal simulated time, and their product, for the exact
/// estimator and for snapshots at several intervals; and what all balance equations cost.
/// `duration` is the simulated time of each run. Writes the table to `json` too, unless that is
/// empty; returns the exit code.
int bench_fields(double duration, const std::string& json);

}  // namespace clatter
