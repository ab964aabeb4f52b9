#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/runs/options.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/scene/scene.h"
#include "engine/scene/scene_differences.h"

namespace clatter {

/// A checkpoint that fits the scene under which its run goes on.
struct Resumed {
  std::string file;
  Checkpoint checkpoint;
  std::vector<KeyDifference> differences;  ///< of the scene from that of the checkpoint

  /// Simulation time at which it was written.
  double time() const;
};

/// Reads the checkpoint that `--resume` names, if any, and gives a scene whose start state was not
/// read what it lacks. Throws UserError unless the checkpoint has the scene's box, disks and walled
/// sides, the seed if one is given, and the laws but for those that --set gives.
std::optional<Resumed> resume(const CommonOptions& common, const CheckpointOptions& options,
                              Scene& scene);

/// Throws UserError where the scene's [measure] block asks for something else than averages that
/// have begun.
void require_same_measure(const Resumed& resumed);

/// Throws UserError where the scene's [view] block asks for another film than that which has begun,
/// but for its speed.
void require_same_view(const Resumed& resumed);

/// All laws that differ, by their keys, separated by commas; empty: none.
std::string changed_laws(const Resumed& resumed);

/// Whether a key of the scene differs.
bool differs(const Resumed& resumed, const std::string& key);

}  // namespace clatter
