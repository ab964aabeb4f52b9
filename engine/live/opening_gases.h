#pragma once

#include <memory>
#include <vector>

#include "engine/live/command.h"
#include "engine/live/gases_in_step.h"
#include "engine/live/opening_run.h"

namespace clatter {

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
