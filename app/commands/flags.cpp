#include "app/commands/flags.h"

#include "app/commands/flag_checks.h"
#include "app/runs/picture_scene.h"
#include "engine/error.h"
#include "render/output/cells.h"

namespace clatter {

void add_scene_flags(CLI::App& command, CommonOptions& options) {
  command
      .add_option("scene", options.scene,
                  "A scene file, a scene of the gallery, or a picture (.png) of this program. A "
                  "picture contains its scene and its seed.")
      ->required()
      ->type_name("SCENE");
  command
      .add_option("--set", options.settings,
                  "Change a key of the scene, as in --set particles.count=500. Repeatable.")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option(
          "--seed", options.seed,
          "Seed of all random numbers. Default: 1, or the seed of the picture or checkpoint.")
      ->check(seed_number());
  command.parse_complete_callback([&options] {
    if (!options.seed) options.seed = seed_of_picture(options.scene);
  });
}

void add_common_flags(CLI::App& command, CommonOptions& options) {
  add_scene_flags(command, options);
  command.add_option("--until", options.until, "Simulation time at the end of the run.")
      ->check(positive_number());
  command.add_flag("--quiet", options.quiet, "Print errors only on stderr.");
}

void add_progress_flag(CLI::App& command, CommonOptions& options) {
  command.add_option("--progress", options.progress, "Form of the progress on stderr.")
      ->transform(one_of<ProgressStyle>({{"auto", ProgressStyle::Auto},
                                         {"json", ProgressStyle::Json},
                                         {"none", ProgressStyle::None}}))
      ->type_name("auto|json|none");
}

void add_compare_flags(CLI::App& command, CompareOptions& options, const std::string& shown_in) {
  command
      .add_option(
          "scenes", options.scenes,
          "Up to three more scenes. The " + shown_in + " shows all gases beside each other.")
      ->type_name("SCENE");
  command
      .add_option("--compare", options.settings,
                  "Show the scene also with another value of a key, in a further cell beside it. "
                  "Repeatable, up to four cells. --set applies to all cells.")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void require_few_gases(const CompareOptions& options, const std::string& shown_in) {
  if (options.count() < static_cast<std::size_t>(kMostCells)) return;
  throw UserError(
      {"", 0, 0},
      "a " + shown_in + " shows at most " + std::to_string(kMostCells) + " gases beside each other",
      "give fewer scenes or --compare");
}

void add_backend_flag(CLI::App& command, Backend& backend) {
  command.add_option("--backend", backend, "Source of OpenGL.")
      ->transform(one_of<Backend>({{name_of(Backend::Auto), Backend::Auto},
                                   {name_of(Backend::Egl), Backend::Egl},
                                   {name_of(Backend::Osmesa), Backend::Osmesa},
                                   {name_of(Backend::Glfw), Backend::Glfw}}))
      ->type_name("auto|glfw|egl|osmesa");
}

void add_checkpoint_flags(CLI::App& command, CheckpointOptions& options) {
  command
      .add_option("--resume", options.resume,
                  "Continue from a checkpoint, under the laws of SCENE.")
      ->check(named_file())
      ->type_name("FILE");
  CLI::Option* file = command
                          .add_option("--checkpoint", options.file,
                                      "Keep a checkpoint up to date. The previous one is "
                                      "FILE.previous. Default: a checkpoint beside the result, "
                                      "only after an interrupt, a stop or a failed output.")
                          ->check(named_file())
                          ->type_name("FILE");
  command
      .add_option("--checkpoint-every", options.every,
                  "Time between checkpoints, in seconds of wall time.")
      ->check(positive_number())
      ->needs(file)
      ->capture_default_str();
}

void add_cluster_flags(CLI::App& command, TaskLimits& limits, bool& dry_run, CLI::Option* slurm) {
  command
      .add_option("--time", limits.time,
                  "Time limit of a task, as for sbatch. Default: that of the partition.")
      ->type_name("HH:MM:SS")
      ->needs(slurm);
  command.add_option("--partition", limits.partition, "Partition. Default: of the cluster.")
      ->type_name("NAME")
      ->needs(slurm);
  command.add_flag("--dry-run", dry_run, "Write the script without submitting it.")->needs(slurm);
}

void add_accuracy_flags(CLI::App& command, AccuracyGoal& goal) {
  CLI::Option* accuracy =
      command
          .add_option(
              "--accuracy", goal.relative,
              "End the run at this relative standard error of the temperature. The run ends at "
              "the latest at --until, or at the end of the scene.")
          ->transform(share())
          ->type_name("SHARE");
  command
      .add_option("--accuracy-of", goal.of,
                  "Mean of the result for --accuracy, for example pressure.left or "
                  "energy.dissipated.")
      ->type_name("NAME")
      ->needs(accuracy)
      ->capture_default_str();
}

}  // namespace clatter
