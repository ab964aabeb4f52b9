#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/runs/options.h"
#include "app/runs/resume.h"
#include "app/system/progress.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/publish/scheduled_run.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Throws PhysicalStop where the particles of a run have overlapped by more than rounding: then
/// events were lost.
void require_no_overlap(const RunChecks& checks);

/// A run that a command makes of a scene: from its start or from a checkpoint, with checkpoints as
/// asked for, and one where it ends before its time.
template <int D>
class Run {
 public:
  /// `out` is what the command writes; empty: stdout. Throws UserError where no checkpoint can go
  /// where one is asked for.
  Run(const std::string& command, const Scene& scene, const CommonOptions& options,
      const CheckpointOptions& checkpoints, std::optional<Resumed> resumed, const std::string& out);

  /// The run itself, at the time from which it goes on.
  ScheduledRun<D>& scheduled() { return *run_; }
  /// Its simulation, until laws change.
  Simulation<D>& simulation() { return run_->simulation(); }
  /// The flag's, or that of the checkpoint, or 1.
  std::uint64_t seed() const { return seed_; }
  /// What [measure] asks for, averaged to `end`, or on from where the checkpoint left it; its
  /// checkpoints keep it. Throws UserError where the block asks for something else than before.
  Measurement<D>& measure(double end);

  /// Runs up to a simulation time in slices of about a tenth of a second, between which progress is
  /// shown and interrupts are seen; false where the run was interrupted or stopped first.
  bool until(double time, Progress& progress);
  /// What checkpoints keep of a film, at the run's time; empty: there is none.
  std::function<std::string()> film_state;
  /// From now on checkpoints are of the run as it is now, until the next call.
  void mark();
  /// Leaves a checkpoint where what the command writes has failed; what to tell about it.
  std::string rescue();
  /// Leaves the checkpoint that the run's end calls for; to be called before anything else is asked
  /// of the measurement.
  void put_aside();
  /// The exit code, or the exception, that the run ends with once its results are written.
  int end();

 private:
  using Clock = std::chrono::steady_clock;

  Checkpoint checkpoint();
  void write();
  void measure_on(Simulation<D>& next);
  void tell_new_averages() const;

  std::string command_;
  Scene scene_;
  bool quiet_;
  CheckpointOptions options_;
  std::filesystem::path file_;  // the checkpoint, asked for or not
  std::optional<Resumed> resumed_;
  bool averages_go_on_ = false;  // those of the run that is resumed
  std::uint64_t seed_;
  std::optional<ScheduledRun<D>> run_;
  double measure_end_ = 0.0;
  std::optional<Measurement<D>> measurement_;
  std::optional<Checkpoint> marked_;
  Clock::time_point last_written_ = Clock::now();
  std::string failure_;  // of the last checkpoint
  bool ended_early_ = false;
  std::optional<PhysicalStop> stop_;
};

extern template class Run<2>;
extern template class Run<3>;

}  // namespace clatter
