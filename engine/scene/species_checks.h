#pragma once

#include <toml++/toml.h>

#include <string>

#include "engine/scene/scene_input.h"

namespace clatter {

/// Throws UserError if a document has too many species, before its keys are read: the values of
/// some keys contain the names of all species. `file` is the name for errors.
void check_species_count(const toml::table& root, const std::string& file);

/// Throws UserError if species have no names, the same names, or impossible diameters, and if a
/// pair has an unknown species or comes twice. `root` is the document of the input, and `file` the
/// name for errors.
void check_species(const SceneInput& input, const toml::table& root, const std::string& file);

/// Gives each species of the scene its number of particles. With a start state of a file it is 0
/// without a key. Throws UserError for a species with both keys of its count, or none, and for more
/// particles than an int can count.
void resolve_species(SceneInput& input, const toml::table& root, const std::string& file);

/// The number of particles of a mixture. That of each species comes from the start state, if it is
/// of a file. Throws UserError if the species fill more of the box than spheres or disks can, or if
/// the start state has other numbers than the keys.
int resolve_mixture(SceneInput& input, const toml::table& root, const std::string& file);

}  // namespace clatter
