#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace clatter {

/// The subcommand of that name. Throws UserError where there is none; `what` is the noun for it.
const CLI::App& find_command(const CLI::App& parent, const std::string& name, const char* what);

}  // namespace clatter
