#pragma once

#include <toml++/toml.h>

#include <string>

#include "engine/scene/scene_input.h"

namespace clatter {

/// Throws UserError if keys that are allowed individually contradict each other. The checks are:
/// opposite walls, speed of walls and room between them; an axis that the box lacks; a colour or
/// field of spins without spins; a Gaussian kernel with the exact estimator or too narrow for the
/// cells; increasing times of the camera. `root` is the document of the input, and `file` the name
/// for errors.
void check_scene(const Scene& scene, const toml::table& root, const std::string& file);

/// Throws UserError if the camera follows a particle that does not exist. The scene's count must be
/// known.
void check_followed(const Scene& scene, const toml::table& root, const std::string& file);

/// Throws UserError if a change has neither laws nor a nudge, a puff or a stroke of the piston, or
/// if one of these is impossible. The scene's count must be known.
void check_change_tables(const Scene& scene, const toml::table& root, const std::string& file);

/// The number of particles of the input. Throws UserError if both keys or none are given, if no
/// lattice holds that many, or if the start state has another number.
int resolve_count(const SceneInput& input, const toml::table& root, const std::string& file);

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
