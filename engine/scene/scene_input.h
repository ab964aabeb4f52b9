#pragma once

#include <optional>
#include <string_view>

#include "engine/scene/key_rules.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Content of a scene file: the scene, and the keys that are resolved when it is read.
struct SceneInput {
  int schema = 1;            ///< version of the format
  std::optional<int> count;  ///< number of particles; not together with the fraction
  std::optional<double>
      packing_fraction;  ///< phi: area_fraction of disks, volume_fraction of spheres
  bool spins = true;     ///< whether the keys of spins are allowed
  Scene scene;

  /// The dotted key of the packing fraction.
  std::string_view packing_key() const {
    return scene.dimension() == 2 ? "particles.area_fraction" : "particles.volume_fraction";
  }
  /// Presence of keys that only spins need.
  Presence spin_key() const { return spins ? kOptional : kNotWithoutSpins; }
};

}  // namespace clatter
