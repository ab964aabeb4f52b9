#pragma once

#include <toml++/toml.h>

#include <string>

#include "engine/scene/scene.h"

namespace clatter {

/// Throws UserError about an obstacle or a partition that is not a body in the box, has the name of
/// another, or names a species that the scene lacks.
void check_fixtures(const Scene& scene, const toml::table& root, const std::string& file);

/// Throws UserError about a piston that cannot slide in the box, or numbers of particles beside it
/// or a partition that have no room there.
void check_divider(const Scene& scene, const toml::table& root, const std::string& file);

}  // namespace clatter
