#pragma once

#include <string>
#include <vector>

#include "app/bench/comparison.h"
#include "app/bench/parameter_sweeps.h"

namespace clatter {

/// What `clatter bench accuracy` is asked for.
struct AccuracyBench {
  std::string scene = "vibrated";  ///< path or gallery name
  double duration = 1000.0;        ///< simulated time of each replica, after a fifth of it
  std::vector<std::string> dials;  ///< names of those asked for; empty: all
  std::string csv;                 ///< files; empty: none
  std::string json;
  std::string plot;      ///< PNG
  std::string markdown;  ///< a page whose table is replaced
};

/// A setting with what its runs found.
struct AccuracyRow {
  std::string setting;
  double value = 0.0;         ///< on the dial; NaN: none
  double cpu_per_time = 0.0;  ///< seconds, the least of any replica; NaN: nothing ran
  double events_per_second = 0.0;
  double bytes = 0.0;
  double deepest_overlap = 0.0;
  double elasticised_share = 0.0;  ///< NaN: no t_c
  Comparison comparison = {};      ///< with the finest setting of its dial
  /// Whether another setting of the dial costs less and errs less, by a tenth at least.
  bool dominated = false;
};

/// A dial's settings, from the finest.
struct AccuracyTable {
  std::string dial;
  std::string title;
  std::vector<AccuracyRow> rows;
};

/// Runs the exact engine, fields and all, at each setting of each dial of a scene, and prints what
/// each costs and how far it is off the finest; returns the exit code.
int bench_accuracy(const AccuracyBench& bench);

}  // namespace clatter
