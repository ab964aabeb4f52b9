#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/physics/theory.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The gas of the theory of vibrated boxes. Absent unless the scene has smooth disks between two
/// equal walls, driven or static, without any other force.
std::optional<VibratedGas> vibrated_gas(const Scene& scene);

/// The predictions of kinetic theory for a scene. Empty unless physics/theory.h covers the scene: a
/// gas between two vibrated walls, or a gas in a periodic box.
nlohmann::ordered_json theory_json(const Scene& scene);

}  // namespace clatter
