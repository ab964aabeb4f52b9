#pragma once

#include <optional>
#include <string>

#include "app/measure/accuracy_goal.h"
#include "app/runs/event_recorder.h"
#include "app/runs/options.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The options of `clatter measure`.
struct MeasureOptions {
  CommonOptions common;
  CheckpointOptions checkpoints;
  AccuracyGoal accuracy;
  int replicas = 1;            ///< runs with consecutive seeds
  std::optional<int> threads;  ///< of a large gas, or parallel replicas; absent: processors()
  std::string out;             ///< result file; empty: stdout
  std::string csv;             ///< folder for tables; empty: none
  std::string vtk;             ///< folder for maps; empty: none
  std::string hdf5;            ///< file for all results; empty: none
  std::string trajectory;      ///< file for the states at equal intervals; empty: none
  double every = 0.0;          ///< interval of the trajectory, in simulation time
  std::string events;          ///< file for the collisions; empty: none
  EventSelection selection;    ///< of the collisions in the file
  std::string save_state;      ///< file for the state at the end; empty: none
};

/// Throws UserError if a measurement between two simulation times would have more than 1e7 samples.
void require_bounded_samples(const Measure& measure, double begin, double end);

/// Measures a scene and writes the results. Returns the exit code. Throws UserError, RunError,
/// PhysicalStop, and Interrupted before the run begins.
int measure(const MeasureOptions& options);

}  // namespace clatter
