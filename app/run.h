#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/progress.h"
#include "app/resume.h"
#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The simulation that a scene and a seed ask for, at time 0.
std::unique_ptr<Simulation<2>> simulation_of(const Scene& scene, std::uint64_t seed);

/// A run that a command makes of a scene: from its start or from a checkpoint, with checkpoints as
/// asked for, and one where it ends before its time.
class Run {
 public:
  /// `out` is what the command writes; empty: stdout. Throws UserError where no checkpoint can go
  /// where one is asked for.
  Run(const std::string& command, const Scene& scene, const CommonOptions& options,
      const CheckpointOptions& checkpoints, std::optional<Resumed> resumed, const std::string& out);

  /// The simulation, at the time from which it goes on.
  Simulation<2>& simulation() { return *simulation_; }
  /// The flag's, or that of the checkpoint, or 1.
  std::uint64_t seed() const { return seed_; }
  /// What [measure] asks for, averaged to `end`, or on from where the checkpoint left it; its
  /// checkpoints keep it. Throws UserError where the block asks for something else than before.
  Measurement& measure(double end);

  /// Runs up to a simulation time in slices of about a tenth of a second, between which progress is
  /// shown and interrupts are seen; false where the run was interrupted or stopped first.
  bool until(double time, Progress& progress);
  /// Leaves the checkpoint that the run's end calls for; to be called before anything else is asked
  /// of the measurement.
  void put_aside();
  /// The exit code, or the exception, that the run ends with once its results are written.
  int end();

 private:
  using Clock = std::chrono::steady_clock;

  void write();
  bool measures_anew() const;

  std::string command_;
  Scene scene_;
  bool quiet_;
  CheckpointOptions options_;
  std::filesystem::path file_;  // the checkpoint, asked for or not
  std::optional<Resumed> resumed_;
  bool had_spins_ = false;  // whether the run that is resumed carried spins
  std::uint64_t seed_;
  std::unique_ptr<Simulation<2>> simulation_;
  std::optional<Measurement> measurement_;
  Clock::time_point last_written_ = Clock::now();
  std::string failure_;  // of the last checkpoint
  bool ended_early_ = false;
  std::optional<PhysicalStop> stop_;
};

}  // namespace clatter
