#pragma once

#include <string>

#include "app/commands/command_tree.h"

namespace clatter {

// Shell scripts that complete command lines: commands, flags, choices, scenes of the gallery, keys
// of scenes, and files.
std::string bash_completions(const CommandInfo& program);
std::string zsh_completions(const CommandInfo& program);
std::string fish_completions(const CommandInfo& program);

}  // namespace clatter
