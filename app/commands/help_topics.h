#pragma once

#include <string>

#include "app/commands/command_tree.h"

namespace clatter {

/// The documentation of one key of the scene file, of all keys in a table, or of all keys if the
/// name is empty. Throws UserError for an unknown key.
std::string key_help(const std::string& name);

/// Writes the tables of keys into the Markdown page of this name. The keys of a table replace the
/// part "keys of TABLE". The keys outside tables replace the part "keys of the scene". Throws
/// UserError if a part is absent.
void write_key_tables(const std::string& page);

/// The manual page of the program in the macros of man(7).
std::string manual_page(const CommandInfo& program);

}  // namespace clatter
