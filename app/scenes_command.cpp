#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/commands.h"
#include "engine/embedded_file.h"

namespace clatter {

void add_scenes_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("scenes", "List the gallery, one line each");
  command->callback([&exit_code] {
    for (const EmbeddedFile& file : embedded_scenes()) {
      const std::string name(file.name.substr(0, file.name.rfind('.')));
      const Scene scene = parse_scene(file.bytes, name);
      std::printf("%-14s %s: %s\n", name.c_str(), scene.title.c_str(), scene.caption.c_str());
    }
    exit_code = kOk;
  });
}

}  // namespace clatter
