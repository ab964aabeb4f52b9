#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/runs/options.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/scene/scene.h"
#include "engine/scene/scene_differences.h"

namespace clatter {

/// A checkpoint that is compatible with the scene of the resumed run.
struct Resumed {
  std::string file;
  Checkpoint checkpoint;
  std::vector<KeyDifference> differences;  ///< between the scene and the scene of the checkpoint

  /// Simulation time of the checkpoint.
  double time() const;
};

/// Reads the checkpoint of `--resume`, if any. Fills in the parts of the scene that come from an
/// unread start state. Throws UserError if the box, the disks or the walled sides differ from the
/// checkpoint. Throws it also for another seed, and for other laws unless --set gives them.
std::optional<Resumed> resume(const CommonOptions& common, const CheckpointOptions& options,
                              Scene& scene);

/// Key of the time at which averages start.
inline constexpr const char* kBurnInKey = "measure.burn_in";

/// Throws UserError if [measure] of the scene differs from the averages in the checkpoint. A run
/// that `burns_in`, within the burn-in of the scene, may have had another burn-in.
void require_same_measure(const Resumed& resumed, bool burns_in);

/// Whether [view] of the scene is that of the checkpoint. The speed may differ.
bool has_same_view(const Resumed& resumed);

/// Throws UserError if [view] of the scene differs from the film in the checkpoint. The speed may
/// differ.
void require_same_view(const Resumed& resumed);

/// The keys of all laws that differ, separated by commas. Empty if none differs.
std::string changed_laws(const Resumed& resumed);

/// Whether a key of the scene differs.
bool differs(const Resumed& resumed, const std::string& key);

}  // namespace clatter
