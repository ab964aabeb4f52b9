#pragma once

#include <string>

#include "app/sweep/sweep_folder.h"

namespace clatter {

/// The resources of the tasks of a sweep on a cluster.
struct TaskLimits {
  int chunk = 0;          ///< runs per task; 0: few enough for 1000 tasks
  std::string time;       ///< time limit as for sbatch --time; empty: that of the partition
  std::string partition;  ///< partition of the cluster; empty: the default
};

/// The runs without result as a command line of GNU parallel, for the processors of one machine, in
/// tasks of `chunk` runs. Empty if there are none.
std::string parallel_line(const SweepFolder& folder, int chunk);

/// Writes a batch script for Slurm into the folder: one array job with all runs without result.
/// Returns its path; empty if there are none. A task that receives SIGTERM, or SIGUSR1 before its
/// time limit, writes checkpoints. After SIGUSR1 it queues itself again. Throws RunError.
std::filesystem::path write_batch_script(const SweepFolder& folder, const TaskLimits& limits);

/// Replaces this process by sbatch for this script. Throws RunError if there is no sbatch.
[[noreturn]] void submit_batch(const std::filesystem::path& script);

}  // namespace clatter
