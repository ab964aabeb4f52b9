#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "app/runs/event_recorder.h"
#include "app/runs/options.h"
#include "app/runs/resume.h"
#include "app/runs/trajectory_recorder.h"
#include "app/system/progress.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Throws PhysicalStop if disks have overlapped by more than rounding errors. An overlap proves
/// lost events.
void require_no_overlap(const RunChecks& checks);

/// The path of a run's checkpoint: of --checkpoint, or the automatic one beside the output `out`.
/// Without a file or folder as output, the automatic name has the scene and the seed.
std::filesystem::path checkpoint_path(const CommonOptions& options,
                                      const CheckpointOptions& checkpoints,
                                      const std::optional<Resumed>& resumed,
                                      const std::string& out);

/// Throws UserError if the checkpoint `file` or its FILE.previous would replace a file that is no
/// checkpoint, and RunError if a requested checkpoint cannot be written.
void require_checkpoint_place(const std::filesystem::path& file,
                              const CheckpointOptions& checkpoints);

/// The run of a command, from its start or from a checkpoint. Writes the requested checkpoints, and
/// one at an early end.
template <int D>
class Run {
 public:
  /// `file` is the result of checkpoint_path(). Throws Interrupted before the run begins.
  Run(const std::string& command, const Scene& scene, const CommonOptions& options,
      const CheckpointOptions& checkpoints, std::optional<Resumed> resumed,
      const std::filesystem::path& file);

  /// The run, at its first simulation time.
  ScheduledRun<D>& scheduled() { return *run_; }
  /// The simulation of the run.
  Simulation<D>& simulation() { return run_->simulation(); }
  /// The seed of the flag, or of the checkpoint, or 1.
  std::uint64_t seed() const { return seed_; }
  /// The measurement of [measure], up to `end`. Continues the averages of the checkpoint.
  /// Checkpoints include it. Throws UserError if [measure] differs from the block of the
  /// checkpoint.
  Measurement<D>& measure(double end);

  /// Writes the states at the times 0, `every`, 2 `every` and so on into a trajectory file.
  /// Continues the trajectory of the checkpoint. Throws UserError and RunError.
  void record(const std::filesystem::path& file, double every);
  /// Writes the selected collisions into an event log. Continues the log of the checkpoint. Throws
  /// UserError and RunError.
  void log_events(const std::filesystem::path& file, const EventSelection& selection);
  /// Notes which files of the checkpoint's run do not continue: its trajectory and its event log.
  void note_left_files() const;

  /// Runs to a simulation time in slices of about 0.1 s of wall time. Between slices it shows
  /// progress and tests for interrupts. Returns false after an early end: an interrupt or a stop.
  /// Throws RunError if the trajectory or the event log cannot be written.
  bool until(double time, Progress& progress);
  /// Ends the run early, by an interrupt or by the stop of a gas beside it.
  void end_early(std::optional<PhysicalStop> stop = {}) {
    ended_early_ = true;
    if (stop) stop_ = std::move(stop);
  }
  /// Whether the last until() had an early end.
  bool ended_early() const { return ended_early_; }
  /// The film state for checkpoints, at the time of the run. Empty without a film.
  std::function<std::string()> film_state;
  /// Until the next call, checkpoints have the present state of the run.
  void mark();
  /// Writes a checkpoint after a failed output. Returns a sentence about it for the error.
  std::string rescue();
  /// Writes the checkpoint that the end of the run requires. To be called before the results of the
  /// measurement are read, which close its last window.
  void put_aside();
  /// Ends the trajectory and the event log. Returns the exit code, or throws the error of the run.
  /// To be called after the results are written.
  int end();

 private:
  using Clock = std::chrono::steady_clock;

  Checkpoint checkpoint();
  void write();
  bool advance(double time, Progress& progress);
  void note_new_averages() const;
  // Whether particles have spins at some time of the run.
  bool ever_spins() const;
  std::string how_to_resume() const;
  std::string finish_files();

  std::string command_;
  Scene scene_;
  bool quiet_;
  CheckpointOptions options_;
  std::filesystem::path file_;  // path of the requested or the automatic checkpoint
  std::optional<Resumed> resumed_;
  bool averages_go_on_ = false;  // whether the averages of the checkpoint continue
  std::uint64_t seed_;
  std::optional<ScheduledRun<D>> run_;
  std::optional<Measurement<D>> measurement_;
  double told_start_ = 0.0;  // of the averages, at the last note
  std::optional<TrajectoryRecorder<D>> recorder_;
  std::optional<EventRecorder<D>> events_;
  std::optional<Checkpoint> marked_;
  Clock::time_point last_written_ = Clock::now();
  std::string failure_;  // failure of the last checkpoint
  bool ended_early_ = false;
  std::optional<PhysicalStop> stop_;
};

extern template class Run<2>;
extern template class Run<3>;

}  // namespace clatter
