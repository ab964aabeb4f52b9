#pragma once

#include <string>
#include <vector>

#include "app/bench/comparison.h"
#include "app/bench/parameter_sweeps.h"

namespace clatter {

/// Options of `clatter bench accuracy`.
struct AccuracyBench {
  std::string scene = "vibrated";  ///< path or gallery name
  double duration = 1000.0;        ///< simulated time of each replica, after a burn-in of one fifth
  std::vector<std::string> dials;  ///< names of the selected sweeps; empty: all
  std::string csv;                 ///< output file; empty: none
  std::string json;
  std::string plot;      ///< PNG
  std::string markdown;  ///< page with a table to replace
};

/// A setting with the results of its runs.
struct AccuracyRow {
  std::string setting;
  double value = 0.0;         ///< of the parameter; NaN: none
  double cpu_per_time = 0.0;  ///< CPU seconds per time, the least of all replicas; NaN: no run
  double events_per_second = 0.0;
  double bytes = 0.0;
  double deepest_overlap = 0.0;
  double elasticised_share = 0.0;  ///< NaN: no t_c
  Comparison comparison = {};      ///< with the finest setting of the sweep
  /// Whether another setting has both a lower cost and a lower error, by at least one tenth.
  bool dominated = false;
};

/// The settings of a sweep, from the finest.
struct AccuracyTable {
  std::string dial;
  std::string title;
  std::vector<AccuracyRow> rows;
};

/// Runs the exact engine with all fields at each setting of each sweep of a scene. Prints the cost
/// of each setting and its deviation from the finest. Returns the exit code.
int bench_accuracy(const AccuracyBench& bench);

}  // namespace clatter
