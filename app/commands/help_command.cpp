#include <CLI/CLI.hpp>

#include "app/commands/command_tree.h"
#include "app/commands/commands.h"
#include "app/commands/help_topics.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"

namespace clatter {

namespace {

void print_help(const CLI::App& program, const std::vector<std::string>& names) {
  // Only keys of scenes contain a dot.
  if (names.size() == 1 && names[0].find('.') != std::string::npos) {
    print(key_help(names[0]));
    return;
  }
  const CLI::App* command = &program;
  std::string path;  // precedes the command's name
  for (const std::string& name : names) {
    path += (path.empty() ? "" : " ") + command->get_name();
    command = &find_command(*command, name, command == &program ? "command" : "table");
  }
  print(command->get_formatter()->make_help(
      command, (path.empty() ? "" : path + " ") + command->get_name(), CLI::AppFormatMode::Normal));
}

void add_keys_topic(CLI::App& help, int& exit_code) {
  struct Options {
    std::string key, markdown;
  };
  auto options = std::make_shared<Options>();
  CLI::App* keys = help.add_subcommand(
      "keys", "Print the keys of a scene file, with unit, default, values and meaning.");
  keys->add_option("key", options->key,
                   "A key or a table, for example particles.restitution. Default: all keys.")
      ->type_name("KEY");
  keys->add_option("--markdown", options->markdown,
                   "Page for the tables of keys. Nothing is printed.")
      ->type_name("FILE.md");
  keys->callback([options, &exit_code] {
    if (options->markdown.empty()) {
      print(key_help(options->key));
    } else {
      write_key_tables(options->markdown);
    }
    exit_code = kOk;
  });
}

}  // namespace

void add_help_command(CLI::App& program, int& exit_code) {
  struct Options {
    std::vector<std::string> names;
    bool man = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* help =
      program.add_subcommand("help", "Print the help of a command, or the keys of a scene.");
  help->add_option(
          "command", options->names,
          "A command, for example render or bench engine. Or a key of a scene, for example "
          "particles.restitution.")
      ->type_name("COMMAND");
  add_keys_topic(*help, exit_code);
  help->add_flag("--man", options->man, "Print the manual page of the program, for man.");
  help->callback([&program, help, options, &exit_code] {
    if (options->man) {
      print(manual_page(command_tree(program)));
    } else if (help->get_subcommands().empty()) {
      print_help(program, options->names);
    }
    exit_code = kOk;
  });
}

}  // namespace clatter
