#pragma once

#include <string>

#include "app/commands/command_tree.h"

namespace clatter {

// Scripts that complete the program's command lines: commands, flags, choices, gallery names, keys
// of scenes, and files.
std::string bash_completions(const CommandInfo& program);
std::string zsh_completions(const CommandInfo& program);
std::string fish_completions(const CommandInfo& program);

}  // namespace clatter
