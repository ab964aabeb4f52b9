#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/physics/theory.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The gas that theory knows, where the scene is one: smooth disks between two walls that are
/// alike, driven or at rest, on which nothing else acts.
std::optional<VibratedGas> vibrated_gas(const Scene& scene);

/// What kinetic theory predicts of a scene, as far as it is one of the systems that the theories of
/// physics/theory.h describe: a gas between two vibrated walls, or one in a periodic box.
nlohmann::ordered_json theory_json(const Scene& scene);

}  // namespace clatter
