#include "app/commands/flags.h"

#include "app/commands/flag_checks.h"
#include "app/runs/picture_scene.h"

namespace clatter {

void add_scene_flags(CLI::App& command, CommonOptions& options) {
  command
      .add_option("scene", options.scene,
                  "Scene file, name of a gallery scene, or picture (.png) by this program, for its "
                  "scene and seed")
      ->required()
      ->type_name("SCENE");
  command
      .add_option("--set", options.settings,
                  "Change a key of the scene, e.g. --set particles.count=500 (repeatable)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--seed", options.seed,
                  "Seed of all random numbers (default: 1, or that of the picture or checkpoint)")
      ->check(seed_number());
  command.parse_complete_callback([&options] {
    if (!options.seed) options.seed = seed_of_picture(options.scene);
  });
}

void add_common_flags(CLI::App& command, CommonOptions& options) {
  add_scene_flags(command, options);
  command.add_option("--until", options.until, "Simulation time at which the run ends")
      ->check(positive_number());
  command.add_flag("--quiet", options.quiet, "Print nothing on stderr but errors");
}

void add_progress_flag(CLI::App& command, CommonOptions& options) {
  command.add_option("--progress", options.progress, "How to show progress on stderr")
      ->transform(one_of<ProgressStyle>({{"auto", ProgressStyle::Auto},
                                         {"json", ProgressStyle::Json},
                                         {"none", ProgressStyle::None}}))
      ->type_name("auto|json|none");
}

void add_backend_flag(CLI::App& command, Backend& backend) {
  command.add_option("--backend", backend, "Where OpenGL comes from")
      ->transform(one_of<Backend>({{"auto", Backend::Auto},
                                   {"egl", Backend::Egl},
                                   {"osmesa", Backend::Osmesa},
                                   {"glfw", Backend::Glfw}}))
      ->type_name("auto|glfw|egl|osmesa");
}

void add_checkpoint_flags(CLI::App& command, CheckpointOptions& options) {
  command
      .add_option("--resume", options.resume,
                  "Go on from a checkpoint, under the laws of the scene given here")
      ->check(named_file())
      ->type_name("FILE");
  CLI::Option* file = command
                          .add_option("--checkpoint", options.file,
                                      "Keep a checkpoint up to date; the one before is "
                                      "FILE.previous (default: one beside the result where the run "
                                      "is interrupted or stops)")
                          ->check(named_file())
                          ->type_name("FILE");
  command.add_option("--checkpoint-every", options.every, "How often, in seconds of wall time")
      ->check(positive_number())
      ->needs(file)
      ->capture_default_str();
}

void add_accuracy_flags(CLI::App& command, AccuracyGoal& goal) {
  CLI::Option* accuracy =
      command
          .add_option(
              "--accuracy", goal.relative,
              "End once the standard error of the temperature is that share of it, e.g. 1% or "
              "0.01; at --until, or else at the scene's end, at the latest")
          ->transform(share())
          ->type_name("SHARE");
  command
      .add_option("--accuracy-of", goal.of,
                  "Of which mean of the result --accuracy speaks, e.g. pressure.left or "
                  "energy.dissipated")
      ->type_name("NAME")
      ->needs(accuracy)
      ->capture_default_str();
}

}  // namespace clatter
