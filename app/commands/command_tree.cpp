#include "app/commands/command_tree.h"

#include <sstream>

#include "app/commands/help_formatter.h"
#include "engine/error.h"
#include "engine/text.h"

namespace clatter {

namespace {

// The separator between the name of a type and the description of its check, which is a noun.
constexpr const char* kCheck = ":a ";

std::vector<std::string> split_words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '|');) words.push_back(word);
  return words;
}

Expects expected(const std::string& label) {
  if (label.empty()) return Expects::Nothing;
  if (label.starts_with("FILE") || label == "IN" || label == "OUT") return Expects::File;
  if (label.find('|') != std::string::npos) return Expects::Word;
  if (label == "DIR") return Expects::Folder;
  if (label == "SCENE") return Expects::Scene;
  if (label == "KEY=VALUE") return Expects::Setting;
  if (label == "KEY") return Expects::Key;
  if (label == "COMMAND") return Expects::Command;
  return Expects::Text;
}

FlagInfo info_of(const CLI::Option& option, const std::vector<std::string>& commands) {
  FlagInfo flag;
  for (const std::string& name : option.get_snames()) flag.names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  flag.label = value_label(option);
  flag.help = option_help(option);
  flag.expects = expected(flag.label);
  if (flag.expects == Expects::Word) flag.words = split_words(flag.label);
  if (flag.expects == Expects::Command) flag.words = commands;
  return flag;
}

CommandInfo info_of(const CLI::App& app, const std::vector<std::string>& path,
                    const std::vector<std::string>& commands) {
  CommandInfo info{path, app.get_description(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    const FlagInfo flag = info_of(*option, commands);
    (flag.names.empty() ? info.arguments : info.flags).push_back(flag);
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    std::vector<std::string> inner = path;
    inner.push_back(command->get_name());
    info.commands.push_back(info_of(*command, inner, commands));
  }
  return info;
}

}  // namespace

std::string value_label(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name();
  const std::string label = type.substr(0, type.find(kCheck));
  if (label == "FLOAT") return "NUMBER";
  return label == "INT" || label == "UINT" ? "N" : label;
}

std::string allowed_values(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t check = type.find(kCheck);
  return check == std::string::npos ? "" : type.substr(check + 1);
}

CommandInfo command_tree(const CLI::App& program) {
  std::vector<std::string> commands;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands.push_back(command->get_name());
  }
  return info_of(program, {}, commands);
}

std::vector<const CommandInfo*> all_commands(const CommandInfo& tree) {
  std::vector<const CommandInfo*> all = {&tree};
  for (const CommandInfo& command : tree.commands) {
    const std::vector<const CommandInfo*> inner = all_commands(command);
    all.insert(all.end(), inner.begin(), inner.end());
  }
  return all;
}

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
