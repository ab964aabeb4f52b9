#pragma once

#include "app/sweep/sweep_folder.h"
#include "app/system/progress.h"

namespace clatter {

/// The runs of a sweep by their state. Each list has the numbers of its runs, in order.
struct SweepState {
  std::vector<int> failed;     ///< runs with a recorded failure and no result
  std::vector<int> done;       ///< runs with a result
  std::vector<SweepRun> runs;  ///< all runs; run ID has the index ID - 1
  std::vector<int> open;       ///< all others
  std::vector<int> wanted;     ///< open runs, and failed runs that can succeed when repeated

  /// The state of a folder.
  explicit SweepState(const SweepFolder& folder);
};

/// "run 17 (particles.count=200, seed 3)".
std::string name_of(const SweepRun& run);

/// Prints the numbers of runs by state to stderr, and the reason of each failure.
void print_state(const SweepFolder& folder);

/// Measures all runs without result, in as many processes at once as given. Failures that would
/// occur again are not repeated. An interrupt lets the processes write their checkpoints. Prints
/// the progress and the failures to stderr. Returns the exit code.
int execute_sweep(const SweepFolder& folder, int processes, ProgressStyle style);

/// Measures one run of a sweep. A run with a result is not measured again. A run with a checkpoint
/// continues from it. If another process measures the run, waits for its end. Returns the exit
/// code; a failure is recorded in the folder and printed to stderr.
int measure_run(SweepFolder& folder, int id, ProgressStyle progress);

}  // namespace clatter
