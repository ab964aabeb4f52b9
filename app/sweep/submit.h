#pragma once

#include <string>

#include "app/sweep/sweep_folder.h"
#include "app/system/batch_script.h"

namespace clatter {

/// Memory of a process that measures the largest run of a sweep, in bytes.
double run_memory(const SweepFolder& folder);

/// The runs without result as a command line of GNU parallel, for the processors of one machine, in
/// tasks of `chunk` runs. Empty if there are none.
std::string parallel_line(const SweepFolder& folder, int chunk);

/// Writes a batch script for Slurm into the folder: one array job with all runs without result.
/// `chunk` is the number of runs per task; 0: few enough for 1000 tasks, or for the limit of the
/// cluster. Returns the path of the script; empty if there are no runs. Throws UserError if the
/// cluster allows fewer tasks, and RunError.
std::filesystem::path write_batch_script(const SweepFolder& folder, int chunk,
                                         const TaskLimits& limits);

}  // namespace clatter
