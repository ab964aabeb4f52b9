#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/system/progress.h"
#include "engine/scene/scene_file.h"
#include "render/context/context.h"

namespace CLI {
class App;
}

namespace clatter {

/// What the program returns to the shell.
enum ExitCode {
  kOk = 0,
  kFailed = 1,        ///< a run or a check failed
  kWrongUse = 2,      ///< wrong use or a wrong scene
  kPhysicalStop = 3,  ///< collapse, overlap
  kInterrupted = 130  ///< after saving what there is
};

/// Flags that every command with a scene takes.
struct CommonOptions {
  std::string scene;                  ///< path of a scene or picture, or gallery name
  std::vector<std::string> settings;  ///< "key=value" of each --set
  std::optional<std::uint64_t> seed;  ///< absent: the checkpoint's, or 1
  std::optional<double> until;        ///< simulation time at which the run ends
  int threads = 2;                    ///< of picture encoders
  bool quiet = false;                 ///< nothing on stderr but errors
  ProgressStyle progress = ProgressStyle::Auto;

  /// The progress to show, given --quiet.
  ProgressStyle shown_progress() const { return quiet ? ProgressStyle::None : progress; }
};

/// Flags of commands that can put a run aside and take it up again.
struct CheckpointOptions {
  std::string resume;    ///< checkpoint from which the run goes on; empty: none, from the start
  std::string file;      ///< checkpoint that is kept up to date; empty: none
  double every = 600.0;  ///< how often, in seconds of wall time

  /// A run that goes on needs no file of a start state.
  StartFile start_file() const { return resume.empty() ? StartFile::Read : StartFile::Skip; }
};

/// The scene with the flags' settings. Throws UserError.
Scene load(const CommonOptions& options, StartFile start_file = StartFile::Read);
/// The same of a command that takes disks only. Throws UserError for spheres, too.
Scene load_disks(const CommonOptions& options, StartFile start_file = StartFile::Read);

/// Each adds its subcommand to the program; choosing it runs it and stores its exit code.
void add_view_command(CLI::App& program, int& exit_code);
void add_measure_command(CLI::App& program, int& exit_code);
void add_render_command(CLI::App& program, int& exit_code);
void add_check_command(CLI::App& program, int& exit_code);
void add_scenes_command(CLI::App& program, int& exit_code);
void add_bench_command(CLI::App& program, int& exit_code);

/// Adds the flags of CommonOptions that say what runs to a command; `options` outlives it.
void add_scene_flags(CLI::App& command, CommonOptions& options);

/// Adds all flags of CommonOptions to a command; `options` outlives it.
void add_common_flags(CLI::App& command, CommonOptions& options);

/// Adds --backend to a command that draws; `backend` outlives it.
void add_backend_flag(CLI::App& command, Backend& backend);

/// Adds the flags of CheckpointOptions to a command; `options` outlives it.
void add_checkpoint_flags(CLI::App& command, CheckpointOptions& options);

/// Runs the program: parses the command line, runs the command, turns every error into a message on
/// stderr and an exit code.
int run_program(int argc, const char* const* argv);

}  // namespace clatter
