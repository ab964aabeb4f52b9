#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/live/command.h"
#include "engine/live/gases_in_step.h"
#include "engine/live/watched_run.h"

namespace clatter {

/// A run that is being started, in parts.
class OpeningRun {
 public:
  /// Begins the run of a scene and a seed. Its record of past states has at most `record_bytes`.
  /// Throws UserError if the machine has not enough memory.
  OpeningRun(const Scene& scene, std::uint64_t seed, std::size_t record_bytes = kRecordBytes);

  /// Continues until the run is complete. Returns false at a request to pause. The longest part
  /// without a look at the request sorts all particles. Throws PhysicalStop if the state is
  /// impossible.
  bool advance(const StopRequest& pause);
  /// Estimate of the completed part, 0..1.
  double progress() const { return made_ ? 1.0 : maker_.progress(); }
  /// The run. Requires that advance() has returned true.
  std::unique_ptr<WatchedRun> take() { return std::move(run_); }

 private:
  Scene scene_;
  std::uint64_t seed_;
  std::size_t record_bytes_;
  StartMaker maker_;
  bool made_ = false;  // all particles have their places
  std::optional<AnyState> start_;
  std::unique_ptr<WatchedRun> run_;
};

/// The scenes of an Open command, whose runs are being started in parts.
class OpeningGases {
 public:
  /// Begins the work. If the command keeps the gas, runs start with the particles of the `present`
  /// ones; nullptr: there are none. Throws UserError if the machine has not enough memory.
  OpeningGases(const command::Open& asked, const GasesInStep* present, std::size_t record_bytes);

  /// The command.
  const command::Open& asked() const { return asked_; }
  /// Continues until all runs are complete. Returns at a request to pause. Throws PhysicalStop if a
  /// state is impossible.
  void advance(const StopRequest& pause);
  /// Whether all runs are complete.
  bool complete() const { return complete_; }
  /// Estimate of the completed part, 0..1.
  double progress() const;
  /// The runs, in order of their numbers. Requires complete().
  std::vector<std::unique_ptr<WatchedRun>> take();

 private:
  command::Open asked_;
  std::vector<std::unique_ptr<OpeningRun>> runs_;
  bool complete_ = false;
};

}  // namespace clatter
