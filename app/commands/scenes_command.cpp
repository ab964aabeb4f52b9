#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/commands/commands.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/embedded_file.h"
#include "engine/scene/scene_file.h"

namespace clatter {

void add_scenes_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("scenes", "List the scenes of the gallery.");
  command->callback([&exit_code] {
    std::string list;
    for (const EmbeddedFile& file : embedded_scenes()) {
      const std::string name(file.name.substr(0, file.name.rfind('.')));
      const Scene scene = load_gallery_scene(file);
      list += name + std::string(std::max(1, 15 - static_cast<int>(name.size())), ' ') +
              scene.title + ": " + scene.caption + "\n";
    }
    print(list);
    exit_code = kOk;
  });
}

}  // namespace clatter
