#pragma once

#include "app/sweep/sweep_folder.h"
#include "app/system/progress.h"

namespace clatter {

/// Measures one run of a sweep. A run with a result is not measured again. A run with a checkpoint
/// continues from it. If another process measures the run, waits for its end. Returns the exit
/// code; a failure is recorded in the folder and printed to stderr.
int measure_run(SweepFolder& folder, int id, ProgressStyle progress);

}  // namespace clatter
