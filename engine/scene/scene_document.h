#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "engine/error.h"
#include "engine/scene/scene_file.h"

namespace clatter {

/// Parses TOML. Throws UserError if it is malformed; `file` is the name for errors.
toml::table parse_document(std::string_view text, const std::string& file);

/// Sets the value of an override in the document.
void apply_override(toml::table& root, const Override& change);

/// Throws UserError at a key that is not among `known`, a list of dotted paths. The error suggests
/// a similar known key.
void refuse_unknown_keys(const toml::table& root, const std::vector<std::string>& known);

/// Whether the value at a place comes from an override.
bool from_override(const Place& place);

/// Place of the key or table header with this dotted path; if it is absent, of its innermost
/// existing table. An override has no line.
Place place_of(const toml::table& root, std::string_view path, const std::string& file);

/// A value as in a scene file; for a date only "a date".
std::string toml_text(const toml::node& node);

/// Place of a value.
Place place_of(const toml::node& node, const std::string& file);

}  // namespace clatter
