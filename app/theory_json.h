#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/scene/scene.h"

namespace clatter {

/// What kinetic theory predicts of a scene, as far as it is one of the systems that the theories of
/// physics/theory.h describe: a gas between two vibrated walls, or one in a periodic box.
nlohmann::ordered_json theory_json(const Scene& scene);

}  // namespace clatter
