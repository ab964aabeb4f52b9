#include "app/commands/command_tree.h"

#include <vector>

#include "engine/error.h"
#include "engine/scene/text.h"

namespace clatter {

const CLI::App& find_command(const CLI::App& parent, const std::string& name, const char* what) {
  std::vector<std::string> names;
  std::string all;
  for (const CLI::App* command : parent.get_subcommands({})) {
    if (command->get_name() == name) return *command;
    names.push_back(command->get_name());
    all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string near(near_miss(name, names));
  throw UserError(
      {}, std::string("there is no ") + what + " '" + name + "'",
      near.empty() ? std::string("the ") + what + "s are " + all : "did you mean '" + near + "'?");
}

}  // namespace clatter
