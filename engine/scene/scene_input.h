#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/key_rules.h"
#include "engine/scene/scene.h"

namespace clatter {

/// A species with the keys of its count.
struct SpeciesInput {
  std::optional<int> count;                ///< N_s; not together with the fraction
  std::optional<double> packing_fraction;  ///< of the species: area_fraction or volume_fraction
  Species species = {};
};

/// Content of a scene file: the scene, and the keys that are resolved when it is read.
struct SceneInput {
  int schema = 1;            ///< version of the format
  std::optional<int> count;  ///< number of particles; not together with the fraction
  std::optional<double>
      packing_fraction;  ///< phi: area_fraction of disks, volume_fraction of spheres
  std::vector<SpeciesInput> species = {};       ///< of a mixture; empty: particles are alike
  std::vector<std::string> species_names = {};  ///< those of the file, before they are checked
  bool spins = true;                            ///< whether the keys of spins are allowed
  Scene scene;

  /// The dotted key of the packing fraction.
  std::string_view packing_key() const {
    return scene.dimension() == 2 ? "particles.area_fraction" : "particles.volume_fraction";
  }
  /// The name of the packing fraction's key.
  std::string_view packing_name() const {
    return packing_key().substr(std::string_view("particles.").size());
  }
  /// Presence of keys that only spins need.
  Presence spin_key() const { return spins ? kOptional : kNotWithoutSpins; }
};

}  // namespace clatter
