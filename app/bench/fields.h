#pragma once

#include <string>

namespace clatter {

/// Prints the cost and the precision of fields in the vibrated scene. Columns: CPU time relative to
/// a bare run, variance of the T profile at equal simulated time, and their product. Rows: the
/// exact estimator, snapshots at several intervals, and all balance equations. `duration` is the
/// simulated time of each run. Writes the table also to `json`, unless it is empty. Returns the
/// exit code.
int bench_fields(double duration, const std::string& json);

}  // namespace clatter
