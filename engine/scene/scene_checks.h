#pragma once

#include <toml++/toml.h>

#include <string>

#include "engine/scene/scene_keys.h"

namespace clatter {

/// Throws UserError where keys that are each allowed make no scene together: walls without one
/// opposite, too fast or with no room between them, a colour or a field for spins where nothing
/// spins, a Gaussian that has nothing to spread or misses the cells, a camera whose times do not
/// follow each other. `root` is what the input was
/// read from, and `file` the name that errors carry.
void check_scene(const Scene& scene, const toml::table& root, const std::string& file);

/// Throws UserError where the camera follows a particle that the scene, whose count is known, has
/// not.
void check_followed(const Scene& scene, const toml::table& root, const std::string& file);

/// The number of particles that the input asks for; throws UserError where it asks twice, not at
/// all, for more than any lattice holds, or for others than a start state has.
int resolve_count(const SceneInput& input, const toml::table& root, const std::string& file);

}  // namespace clatter
