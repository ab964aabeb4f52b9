#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace clatter {

/// The kind of value of a flag or an argument.
enum class Expects { Nothing, Text, Word, File, Folder, Scene, Setting, Key, Command };

/// A flag of a command, or a positional argument.
struct FlagInfo {
  std::vector<std::string> names;  ///< "-q", "--quality"; empty: a positional argument
  std::string label;               ///< of its value: "FILE", "l|m|h"; empty: no value
  std::string help;                ///< one or more sentences
  Expects expects = Expects::Nothing;
  std::vector<std::string> words = {};  ///< allowed values of a Word or a Command
};

/// A command of the program with its flags and subcommands.
struct CommandInfo {
  std::vector<std::string> path;  ///< "bench", "engine"; empty: the program itself
  std::string help;
  std::vector<FlagInfo> flags;
  std::vector<FlagInfo> arguments;
  std::vector<CommandInfo> commands;
};

/// The tree of all commands of the program.
CommandInfo command_tree(const CLI::App& program);

/// All commands of a tree. The program itself comes first.
std::vector<const CommandInfo*> all_commands(const CommandInfo& tree);

/// The label of an option's value, such as FILE or NUMBER.
std::string value_label(const CLI::Option& option);
/// The values that the check of an option allows, in words. Empty without a check.
std::string allowed_values(const CLI::Option& option);

/// The subcommand of this name. Throws UserError if there is none. `what` is a noun for the error.
const CLI::App& find_command(const CLI::App& parent, const std::string& name, const char* what);

}  // namespace clatter
