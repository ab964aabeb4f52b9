#pragma once

#include <string>

#include "app/commands/command_tree.h"

namespace clatter {

/// The manual page of the program in the macros of man(7).
std::string manual_page(const CommandInfo& program);

}  // namespace clatter
