#include <CLI/CLI.hpp>

#include "app/commands/commands.h"
#include "app/commands/completions.h"
#include "app/commands/flag_checks.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"

namespace clatter {

void add_completions_command(CLI::App& program, int& exit_code) {
  enum class Shell { Bash, Zsh, Fish };
  auto shell = std::make_shared<Shell>();
  CLI::App* command = program.add_subcommand(
      "completions", "Print a script that completes command lines in a shell.");
  command->add_option("shell", *shell, "Name of the shell.")
      ->required()
      ->transform(
          one_of<Shell>({{"bash", Shell::Bash}, {"zsh", Shell::Zsh}, {"fish", Shell::Fish}}))
      ->type_name("bash|zsh|fish");
  command->callback([&program, shell, &exit_code] {
    const CommandInfo tree = command_tree(program);
    print(*shell == Shell::Bash  ? bash_completions(tree)
          : *shell == Shell::Zsh ? zsh_completions(tree)
                                 : fish_completions(tree));
    exit_code = kOk;
  });
}

}  // namespace clatter
