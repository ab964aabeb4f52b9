#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/film/compared_scenes.h"
#include "app/measure/accuracy_goal.h"
#include "app/runs/options.h"
#include "app/system/batch_script.h"
#include "render/context/context.h"

namespace clatter {

// Flags that several commands share. The options must outlive the command.

/// SCENE, --set, --seed.
void add_scene_flags(CLI::App& command, CommonOptions& options);

/// The scene flags, --until, --quiet.
void add_common_flags(CLI::App& command, CommonOptions& options);

/// Further SCENEs and --compare. `shown_in` is the noun of what shows the gases: film, window.
void add_compare_flags(CLI::App& command, CompareOptions& options, const std::string& shown_in);

/// Throws UserError if these are more gases than `shown_in` shows.
void require_few_gases(const CompareOptions& options, const std::string& shown_in);

/// --progress.
void add_progress_flag(CLI::App& command, CommonOptions& options);

/// --backend, of commands that draw.
void add_backend_flag(CLI::App& command, Backend& backend);

/// --resume, --checkpoint, --checkpoint-every.
void add_checkpoint_flags(CLI::App& command, CheckpointOptions& options);

/// --time, --partition, --dry-run of commands with the flag `slurm`.
void add_cluster_flags(CLI::App& command, TaskLimits& limits, bool& dry_run, CLI::Option* slurm);

/// --accuracy, --accuracy-of.
void add_accuracy_flags(CLI::App& command, AccuracyGoal& goal);

}  // namespace clatter
