#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/runs/picture_scene.h"
#include "engine/error.h"
#include "engine/scene/text.h"

namespace clatter {

Scene load(const CommonOptions& options, StartFile start_file) {
  std::vector<Override> overrides;
  for (const std::string& setting : options.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UserError({"--set " + setting, 0, 0}, "no value is set",
                      "write --set key=value, for instance --set particles.count=500");
    }
    overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return load_any_scene(options.scene, overrides, start_file);
}

Scene load_disks(const CommonOptions& options, StartFile start_file) {
  Scene scene = load(options, start_file);
  if (scene.dimension() == 2) return scene;
  throw UserError({options.scene},
                  "the box has three dimensions, and this command takes disks only",
                  "give box.size two numbers, or read the scene with `clatter check`");
}

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
  command.add_option("--threads", options.threads, "Threads that encode pictures")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "Print nothing on stderr but errors");
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
      ->type_name("FILE");
  CLI::Option* file = command
                          .add_option("--checkpoint", options.file,
                                      "Keep a checkpoint up to date; the one before is "
                                      "FILE.previous (default: one beside the result where the run "
                                      "is interrupted or stops)")
                          ->type_name("FILE");
  command.add_option("--checkpoint-every", options.every, "How often, in seconds of wall time")
      ->check(positive_number())
      ->needs(file)
      ->capture_default_str();
}

static int report(const char* message, int code) {
  std::fprintf(stderr, "clatter: %s\n", message);
  return code;
}

// CLI11 itself would only say that a command is missing.
static void require_command(const CLI::App& program, const std::string& word) {
  if (word.starts_with('-')) return;
  std::vector<std::string> names;
  std::string all;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == word) return;
    names.push_back(command->get_name());
    all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string near(near_miss(word, names));
  throw UserError({}, "there is no command '" + word + "'",
                  near.empty() ? "the commands are " + all : "did you mean '" + near + "'?");
}

int run_program(int argc, const char* const* argv) {
  int exit_code = kOk;
  try {
    CLI::App program(
        "Driven granular gases of hard disks: explore, film and measure them.\n"
        "Alone it opens a window. Without a display start with\n"
        "  clatter scenes   and   clatter render vibrated --out vibrated.mp4",
        "clatter");
    program.set_version_flag("--version", "clatter " CLATTER_VERSION);
    program.require_subcommand(1);
    program.failure_message([](const CLI::App*, const CLI::Error& error) {
      return std::string("clatter: ") + error.what() + "; --help after a command lists its flags\n";
    });
    add_view_command(program, exit_code);
    add_render_command(program, exit_code);
    add_measure_command(program, exit_code);
    add_check_command(program, exit_code);
    add_scenes_command(program, exit_code);
    add_bench_command(program, exit_code);
    const char* const view[] = {argv[0], "view"};
    if (argc < 2) {
      argc = 2;
      argv = view;
    }
    require_command(program, argv[1]);
    try {
      program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return program.exit(error) == 0 ? kOk : kWrongUse;
    }
  } catch (const UserError& error) {
    return report(error.what(), kWrongUse);
  } catch (const PhysicalStop& error) {
    return report(error.what(), kPhysicalStop);
  } catch (const std::bad_alloc&) {
    return report("out of memory; give the scene fewer disks or cells", kFailed);
  } catch (const std::exception& error) {
    return report(error.what(), kFailed);
  }
  return exit_code;
}

}  // namespace clatter
