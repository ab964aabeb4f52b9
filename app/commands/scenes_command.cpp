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
    const auto name_of = [](const EmbeddedFile& file) {
      return std::string(file.name.substr(0, file.name.rfind('.')));
    };
    std::size_t longest = 0;
    for (const EmbeddedFile& file : embedded_scenes()) {
      longest = std::max(longest, name_of(file).size());
    }
    std::string list;
    for (const EmbeddedFile& file : embedded_scenes()) {
      std::string name = name_of(file);
      name.resize(longest + 2, ' ');
      const Scene scene = load_gallery_scene(file);
      list += name + scene.title + ": " + scene.caption + "\n";
    }
    print(list);
    exit_code = kOk;
  });
}

}  // namespace clatter
