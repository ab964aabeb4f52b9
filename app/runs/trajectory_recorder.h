#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/results/trajectory_file.h"
#include "engine/dynamics/regular_times.h"
#include "engine/dynamics/simulation.h"
#include "engine/observables/periodic_images.h"

namespace clatter {

/// Writes the exact states of a run into a trajectory at the times 0, `every`, 2 `every` and so on.
/// All frames have the same columns: `spins` states whether they have angular velocities, which are
/// 0 while nothing is rough, and `species` are the names of those of a mixture.
template <int D>
class TrajectoryRecorder {
 public:
  /// Begins a trajectory at the first of the times that the simulation has not passed. Throws
  /// RunError.
  TrajectoryRecorder(const std::filesystem::path& path, double every, bool spins,
                     const std::vector<std::string>& species, Simulation<D>& simulation);
  /// Continues a trajectory from the result of save() at this time of the run. `checkpoint` is the
  /// name for errors. Throws UserError if `every` or `spins` differs or the file lacks frames, and
  /// RunError.
  TrajectoryRecorder(const std::filesystem::path& path, double every, bool spins,
                     const std::vector<std::string>& species, Simulation<D>& simulation,
                     const std::string& saved, const std::string& checkpoint);

  /// The simulation time of the next frame.
  double next_time() const { return times_.of(next_); }
  /// Appends the state of the simulation, which is at next_time(). Throws RunError.
  void add(const Simulation<D>& simulation);
  /// Waits until the frames are on the disk. Returns the state for a checkpoint. Throws RunError.
  std::string save();
  /// Completes the file, with all frames on the disk. Throws RunError, also if an earlier save()
  /// failed.
  void finish();
  /// The flags of `clatter measure` that continue this trajectory.
  std::string flags() const;

 private:
  static TrajectoryParticles particles_of(const Simulation<D>& simulation, bool spins,
                                          const std::vector<std::string>& species);
  void open(const Simulation<D>& simulation, std::uint64_t bytes);

  TrajectoryFormat format_;
  std::filesystem::path path_;
  double every_;
  TrajectoryParticles particles_;
  RegularTimes times_;
  std::uint64_t next_ = 0;  // number of the next frame
  std::optional<PeriodicImages<D>> images_;
  std::unique_ptr<TrajectoryFile<D>> file_;
};

extern template class TrajectoryRecorder<2>;
extern template class TrajectoryRecorder<3>;

}  // namespace clatter
