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

/// Sets the value of an override in the document. The path species.NAME.KEY is that of a key of a
/// species, and pair.NAME.NAME.KEY that of a pair, which is added if it is absent. The paths
/// obstacle.NAME.KEY and partition.NAME.KEY are those of fixtures. Throws UserError for a key that
/// cannot be one, and for a name without an item.
void apply_override(toml::table& root, const Override& change);

/// The value at such a path; nullptr without one.
const toml::node* node_at(toml::table& root, std::string_view path);

/// [S] the names of the items of [[species]], before they are checked.
std::vector<std::string> species_names(const toml::table& root);

/// Throws UserError about a species that is not among `names`.
[[noreturn]] void refuse_species(const Place& place, std::string_view name,
                                 const std::vector<std::string>& names);

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
