#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/results/trajectory.h"
#include "app/runs/regular_times.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/images.h"

namespace clatter {

/// Writes the exact states of a run into a trajectory at the times 0, `every`, 2 `every` and so on.
template <int D>
class TrajectoryRecorder {
 public:
  /// Begins a trajectory at the first of the times that the simulation has not passed. Throws
  /// RunError.
  TrajectoryRecorder(const std::filesystem::path& path, double every, Simulation<D>& simulation);
  /// Continues a trajectory from the result of save() at this time of the run. `checkpoint` is the
  /// name for errors. Throws UserError if `every` differs or the file lacks frames, and RunError.
  TrajectoryRecorder(const std::filesystem::path& path, double every, Simulation<D>& simulation,
                     const std::string& saved, const std::string& checkpoint);

  /// The simulation time of the next frame.
  double next_time() const { return times_.of(next_); }
  /// Appends the state of the simulation, which is at next_time(). Throws RunError.
  void add(const Simulation<D>& simulation);
  /// Observes the next simulation of the run, before the previous one ends.
  void follow(Simulation<D>& next);
  /// Waits until the frames are on the disk. Returns the state for a checkpoint. Throws RunError.
  std::string save();

 private:
  TrajectoryFormat format_;
  double every_;
  RegularTimes times_;
  long next_ = 0;  // number of the next frame
  std::optional<Images<D>> images_;
  std::optional<TrajectoryFile> file_;
};

extern template class TrajectoryRecorder<2>;
extern template class TrajectoryRecorder<3>;

}  // namespace clatter
