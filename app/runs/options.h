#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/system/progress.h"
#include "engine/scene/scene_file.h"

namespace clatter {

/// Flags that select the run and the amount of messages.
struct CommonOptions {
  std::string scene;                  ///< path of a scene or picture, or gallery name
  std::vector<std::string> settings;  ///< "key=value" of each --set
  std::optional<std::uint64_t> seed;  ///< absent: the checkpoint's, or 1
  std::optional<double> until;        ///< simulation time at which the run ends
  bool quiet = false;                 ///< errors only on stderr
  ProgressStyle progress = ProgressStyle::Auto;

  /// The form of the progress, with --quiet taken into account.
  ProgressStyle shown_progress() const { return quiet ? ProgressStyle::None : progress; }
  /// Whether a --set gives this key of the scene, its table, or a part of it.
  bool sets(std::string_view key) const;
};

/// Flags of commands that write and resume checkpoints.
struct CheckpointOptions {
  std::string resume;    ///< checkpoint to resume; empty: the run starts at time 0
  std::string file;      ///< checkpoint that is kept up to date; empty: none
  double every = 600.0;  ///< interval in seconds of wall time
  bool of_end = true;    ///< whether a complete run writes its end to `file`

  /// A resumed run does not read the file of its start state.
  StartFile start_file() const { return resume.empty() ? StartFile::Read : StartFile::Skip; }
};

/// The scene with the settings of the flags. Prints a note if its start state seems cut off. Throws
/// UserError.
Scene load(const CommonOptions& options, StartFile start_file = StartFile::Read);

/// The files that a command reads and must not overwrite: scene, start state and resumed
/// checkpoint. The list omits a resumed checkpoint that is `checkpoint`, which the command keeps up
/// to date, or its previous one.
std::vector<std::filesystem::path> inputs_of(const CommonOptions& options,
                                             const CheckpointOptions& checkpoints,
                                             const Scene& scene,
                                             const std::filesystem::path& checkpoint);

}  // namespace clatter
