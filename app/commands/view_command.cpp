#include <CLI/CLI.hpp>

#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/system/exit_code.h"
#include "app/view/window.h"
#include "engine/error.h"

namespace clatter {

namespace {

struct ViewOptions {
  CommonOptions common;
  std::string size = "1280x800";
  Backend backend = Backend::Auto;
  std::string playlist;
  bool sound = false;
  CompareOptions compare;
  std::string script_log;
};

int view(const ViewOptions& options) {
  if (options.backend == Backend::Egl || options.backend == Backend::Osmesa) {
    throw UserError({"--backend", 0, 0}, "this backend has no window",
                    "give glfw, or film the scene with `clatter render`");
  }
  WindowOptions window;
  window.seed = options.common.seed.value_or(1);
  if (options.playlist.empty()) {
    window.scene = load(options.common);
    require_few_gases(options.compare, "window");
    const auto gases =
        compared_scenes({window.scene, window.seed}, options.compare, options.common, true);
    for (std::size_t k = 1; k < gases.size(); ++k) window.others.push_back(gases[k].scene);
  } else {
    window.playlist = load_playlist(options.playlist);
    window.scene = window.playlist.front().scene;
    window.seed = window.playlist.front().seed.value_or(window.seed);
  }
  window.sound = options.sound;
  window.until = options.common.until;
  window.script_log = options.script_log;
  window.size = parse_size(options.size, {320, 240});
  show_window(window);
  return kOk;
}

}  // namespace

void add_view_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  options->common.scene = "vibrated";
  CLI::App* command = program.add_subcommand("view", "Explore a scene in a window.");
  add_scene_flags(*command, options->common);
  CLI::Option* scene = command->get_option("scene")->required(false)->capture_default_str();
  add_compare_flags(*command, options->compare, "window");
  command
      ->add_option("--playlist", options->playlist,
                   "TOML file with a list of scenes for the keys [ and ].")
      ->type_name("FILE")
      ->excludes(scene)
      ->excludes("--set")
      ->excludes("--compare");
  command->add_option("--size", options->size, "Size of the window in pixels.")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  command
      ->add_option("--until", options->common.until,
                   "Simulation time at which the gas pauses. The space bar continues.")
      ->check(positive_number());
  command->add_flag("--sound", options->sound,
                    "Each collision is a click. The key S switches this too.");
  add_backend_flag(*command, options->backend);
  command
      ->add_option("--script-log", options->script_log,
                   "Log of the window for scripts. Each line is a JSON object.")
      ->type_name("FILE");
  command->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace clatter
