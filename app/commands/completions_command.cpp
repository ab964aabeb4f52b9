#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/commands/command_tree.h"
#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/embedded_file.h"
#include "engine/scene/key_docs.h"
#include "engine/scene/scene.h"

// Shell scripts that complete command lines: commands, flags, choices, scenes of the gallery, keys
// of scenes, and files.

namespace clatter {

namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, const char* between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// The first sentence of a help text, without a full stop.
std::string summary(const std::string& help) {
  const std::string line = help.substr(0, help.find('\n'));
  std::string sentence = line.substr(0, line.find(". "));
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

Words gallery_names() {
  Words names;
  for (const EmbeddedFile& file : embedded_scenes()) {
    names.emplace_back(file.name.substr(0, file.name.rfind('.')));
  }
  return names;
}

// All keys of a scene. A box of disks has the keys of walls once per side.
Words key_names() {
  constexpr std::size_t kSidesOfDisks = 4;
  Words names;
  for (const KeyDoc& doc : key_docs()) {
    if (doc.table != "walls.SIDE") {
      names.push_back(doc.path());
      continue;
    }
    for (std::size_t side = 0; side < kSidesOfDisks; ++side) {
      names.push_back(fmt::format("walls.{}.{}", kSideNames[side], doc.key.name));
    }
  }
  return names;
}

Words child_names(const CommandInfo& command) {
  Words names;
  for (const CommandInfo& child : command.commands) names.push_back(child.path.back());
  return names;
}

// The name of a kind of value in the scripts.
const char* kind_name(Expects expects) {
  switch (expects) {
    case Expects::Nothing:
    case Expects::Text:
      return "nothing";
    case Expects::Word:
    case Expects::Command:
      return "words";
    case Expects::File:
      return "files";
    case Expects::Folder:
      return "folders";
    case Expects::Scene:
      return "scenes";
    case Expects::Setting:
      return "settings";
    case Expects::Key:
      return "keys";
  }
  return "nothing";
}

std::string bash_case(const CommandInfo& command) {
  Words flags;
  std::string values;
  for (const FlagInfo& flag : command.flags) {
    flags.insert(flags.end(), flag.names.begin(), flag.names.end());
    if (flag.expects == Expects::Nothing) continue;
    values += fmt::format("        {}) kind={} words='{}' ;;\n", joined(flag.names, "|"),
                          kind_name(flag.expects), joined(flag.words));
  }
  Words words = child_names(command);
  std::string kind = words.empty() ? "nothing" : "words";
  for (const FlagInfo& argument : command.arguments) {
    words.insert(words.end(), argument.words.begin(), argument.words.end());
    if (argument.expects != Expects::Command) kind = kind_name(argument.expects);
  }
  return fmt::format(
      "    '{}')\n      flags='{}' kind={} words='{}'\n"
      "      case $flag in\n{}        *) ;;\n      esac ;;\n",
      joined(command.path), joined(flags), kind, joined(words), values);
}

// A text in single quotes of a shell.
std::string quoted(const std::string& text) {
  return "'" + replaced(text, "'", "'\\''") + "'";
}

// A description in a specification of _arguments.
std::string zsh_description(const std::string& help) {
  std::string text = summary(help);
  for (const char* special : {"[", "]", ":"})
    text = replaced(text, special, std::string("\\") + special);
  return text;
}

// The part of a specification of _arguments for the value of a flag.
std::string zsh_value(const FlagInfo& flag) {
  if (flag.expects == Expects::Nothing) return "";
  const std::string label = ":" + replaced(flag.label, ":", "\\:") + ":";
  switch (flag.expects) {
    case Expects::Word:
    case Expects::Command:
      return label + "(" + joined(flag.words) + ")";
    case Expects::File:
      return label + "_files";
    case Expects::Folder:
      return label + "_files -/";
    case Expects::Scene:
      return label + "__clatter_scenes";
    case Expects::Setting:
      return label + "__clatter_settings";
    case Expects::Key:
      return label + "__clatter_keys";
    default:
      return label + " ";
  }
}

std::string zsh_function_name(const CommandInfo& command) {
  return "_clatter" + (command.path.empty() ? "" : "_" + joined(command.path, "_"));
}

std::string zsh_function(const CommandInfo& command) {
  std::string text = zsh_function_name(command) + "() {\n";
  std::string specifications;
  for (const FlagInfo& flag : command.flags) {
    for (const std::string& name : flag.names) {
      const bool repeatable = flag.expects == Expects::Setting;
      specifications += " \\\n    " + quoted((repeatable ? "*" : "") + name + "[" +
                                             zsh_description(flag.help) + "]" + zsh_value(flag));
    }
  }
  if (command.commands.empty()) {
    const std::size_t count = command.arguments.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::string place = count == 1 ? "*" : std::to_string(k + 1);
      specifications += " \\\n    " + quoted(place + zsh_value(command.arguments[k]));
    }
    return text + "  _arguments -s" + specifications + "\n}\n\n";
  }
  text += "  local state line\n  typeset -A opt_args\n  _arguments -C" + specifications +
          " \\\n    '1: :->command' '*:: :->argument'\n  case $state in\n    command)\n"
          "      local -a commands=(";
  for (const CommandInfo& child : command.commands) {
    text += "\n        " + quoted(child.path.back() + ":" + summary(child.help));
  }
  for (const FlagInfo& argument : command.arguments) {
    for (const std::string& word : argument.words) text += "\n        " + quoted(word);
  }
  text += ")\n      _describe command commands ;;\n    argument)\n      case $words[1] in\n";
  for (const CommandInfo& child : command.commands) {
    text += "        " + child.path.back() + ") " + zsh_function_name(child) + " ;;\n";
  }
  return text + "      esac ;;\n  esac\n}\n\n";
}

// The words that fish offers for a value, in one argument of `complete -a`.
std::string fish_words(const FlagInfo& flag) {
  switch (flag.expects) {
    case Expects::Word:
    case Expects::Command:
      return joined(flag.words);
    case Expects::Folder:
      return "(__fish_complete_directories)";
    case Expects::Scene:
      return joined(gallery_names());
    case Expects::Setting:
      return joined(key_names(), "= ") + "=";
    case Expects::Key:
      return joined(key_names());
    default:
      return "";
  }
}

std::string fish_value(const FlagInfo& flag) {
  if (flag.expects == Expects::Nothing) return "";
  const bool files = flag.expects == Expects::File || flag.expects == Expects::Scene;
  const std::string words = fish_words(flag);
  return std::string(flag.names.empty() ? "" : " -r") + (files ? " -F" : " -f") +
         (words.empty() ? "" : " -a " + quoted(words));
}

std::string fish_lines(const CommandInfo& command) {
  const std::string start =
      "complete -c clatter -n " +
      quoted(joined(command.path.empty() ? Words{"__clatter_command_is"}
                                         : Words{"__clatter_command_is", joined(command.path)}));
  std::string text;
  for (const CommandInfo& child : command.commands) {
    text += start + " -a " + child.path.back() + " -d " + quoted(summary(child.help)) + "\n";
  }
  for (const FlagInfo& argument : command.arguments) text += start + fish_value(argument) + "\n";
  for (const FlagInfo& flag : command.flags) {
    text += start;
    for (const std::string& name : flag.names) {
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    text += " -d " + quoted(summary(flag.help)) + fish_value(flag) + "\n";
  }
  return text;
}

// All commands except the program itself, as in "bench engine".
Words paths(const CommandInfo& program) {
  Words paths;
  for (const CommandInfo* command : all_commands(program)) {
    if (!command->path.empty()) paths.push_back(joined(command->path));
  }
  return paths;
}

}  // namespace

static std::string bash_completions(const CommandInfo& program) {
  std::string commands;
  for (const std::string& path : paths(program)) {
    commands += (commands.empty() ? "" : "|") +
                quoted(path.find(' ') == std::string::npos ? " " + path : path);
  }
  std::string cases;
  for (const CommandInfo* command : all_commands(program)) cases += bash_case(*command);
  std::string script = R"(# Completions of clatter for bash, written by `clatter completions bash`.

_clatter() {
  local current=${COMP_WORDS[COMP_CWORD]} flag=${COMP_WORDS[COMP_CWORD - 1]}
  local command= flags= kind= words= word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$command $word" in
      @commands@) command="${command:+$command }$word" ;;
    esac
  done
  case $command in
@cases@  esac
  COMPREPLY=()
  if [[ $current == -* ]]; then kind=words words=$flags; fi
  case $kind in
    words) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current") ;;
    files)
      compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;
    folders)
      compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    scenes)
      compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -W '@scenes@' -- "$current"; compgen -f -- "$current") ;;
    settings)
      compopt -o nospace
      mapfile -t COMPREPLY < <(compgen -W '@keys@' -S = -- "$current") ;;
    keys) mapfile -t COMPREPLY < <(compgen -W '@keys@' -- "$current") ;;
  esac
}

complete -F _clatter clatter
)";
  script = replaced(script, "@commands@", commands);
  script = replaced(script, "@cases@", cases);
  script = replaced(script, "@scenes@", joined(gallery_names()));
  return replaced(script, "@keys@", joined(key_names()));
}

static std::string zsh_completions(const CommandInfo& program) {
  std::string functions;
  for (const CommandInfo* command : all_commands(program)) functions += zsh_function(*command);
  std::string script = R"(#compdef clatter
# Completions of clatter for zsh, written by `clatter completions zsh`.

__clatter_scenes() {
  _alternative 'gallery:scene of the gallery:(@scenes@)' 'files:file:_files'
}

__clatter_keys() {
  local -a keys=(@keys@)
  compadd "$@" -a keys
}

__clatter_settings() {
  if [[ $PREFIX == *=* ]]; then return 1; fi
  __clatter_keys "$@" -S =
}

@functions@if [[ $funcstack[1] == _clatter ]]; then _clatter "$@"; else compdef _clatter clatter; fi
)";
  script = replaced(script, "@functions@", functions);
  script = replaced(script, "@scenes@", joined(gallery_names()));
  return replaced(script, "@keys@", joined(key_names()));
}

static std::string fish_completions(const CommandInfo& program) {
  std::string known;
  for (const std::string& path : paths(program)) known += " " + quoted(path);
  std::string script = R"(# Completions of clatter for fish, written by `clatter completions fish`.

function __clatter_command_is
  set -l known@known@
  set -l command
  for word in (commandline -opc)[2..-1]
    set -l longer (string trim -- "$command $word")
    if contains -- "$longer" $known
      set command $longer
    end
  end
  test "$command" = "$argv"
end

complete -c clatter -f
)";
  script = replaced(script, "@known@", known);
  for (const CommandInfo* command : all_commands(program)) script += fish_lines(*command);
  return script;
}

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
