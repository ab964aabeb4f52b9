#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace clatter {

/// The kind of text that a flag or an argument expects.
enum class Expects { Nothing, Text, Word, File, Folder, Scene, Setting, Key, Command };

/// A flag of a command, or an argument without a flag.
struct FlagInfo {
  std::vector<std::string> names;  ///< "-q", "--quality"; empty: an argument
  std::string label;               ///< of its value: "FILE", "l|m|h"; empty: it takes none
  std::string help;                ///< in sentences
  Expects expects = Expects::Nothing;
  std::vector<std::string> words = {};  ///< those that a Word or a Command may be
};

/// A command of the program with its flags and subcommands.
struct CommandInfo {
  std::vector<std::string> path;  ///< "bench", "engine"; empty: the program itself
  std::string help;
  std::vector<FlagInfo> flags;
  std::vector<FlagInfo> arguments;
  std::vector<CommandInfo> commands;
};

/// The tree of commands that the program parses.
CommandInfo command_tree(const CLI::App& program);

/// All commands of a tree, the program itself first.
std::vector<const CommandInfo*> all_commands(const CommandInfo& tree);

/// The label of an option's value, such as FILE or NUMBER.
std::string value_label(const CLI::Option& option);
/// The values that the check of an option allows, in words; empty without a check.
std::string allowed_values(const CLI::Option& option);

/// The subcommand of that name. Throws UserError where there is none; `what` is the noun for it.
const CLI::App& find_command(const CLI::App& parent, const std::string& name, const char* what);

}  // namespace clatter
