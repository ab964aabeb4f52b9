#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "engine/error.h"
#include "engine/scene/scene_file.h"

namespace clatter {

/// Parses TOML; throws UserError where it is malformed, `file` being the name that errors carry.
toml::table parse_document(std::string_view text, const std::string& file);

/// Replaces or adds the value that a `--set` names.
void apply_override(toml::table& root, const Override& change);

/// Throws UserError at a key that is not among `known`, which are dotted paths, and names the
/// known one that may have been meant.
void refuse_unknown_keys(const toml::table& root, const std::vector<std::string>& known);

/// Whether an override gave what stands there.
bool from_override(const Place& place);

/// Where the key of this dotted path stands, or a table's header, or else the innermost table on
/// the way to it that the document has; an override has no line.
Place place_of(const toml::table& root, std::string_view path, const std::string& file);

/// Where a value stands.
Place place_of(const toml::node& node, const std::string& file);

}  // namespace clatter
