#pragma once

#include <string>

namespace clatter {

/// The documentation of one key of the scene file, of all keys in one of its tables, or of all keys
/// where the name is empty. Throws UserError where there is no such key.
std::string key_help(const std::string& name);

/// Writes the tables of keys into the Markdown page of that name, each into the part "keys of
/// TABLE". The part "keys of the scene" has the keys outside tables. Throws UserError where a part
/// is absent.
void write_key_tables(const std::string& page);

}  // namespace clatter
