#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "engine/error.h"
#include "engine/vec.h"

namespace clatter {

struct Scene;

/// Particles that enter the gas at one time, with their centres at random places in a region. They
/// have Gaussian velocities and no spin.
struct Puff {
  int count = 1;                      ///< number of particles, >= 1
  VecX centre = {};                   ///< [D] centre of the region, a disk or a ball, in the box
  double radius = 1.0;                ///< of the region, > 0; across periodic sides as well
  double temperature = 1.0;           ///< m times the variance of each velocity component, >= 0
  std::optional<VecX> velocity = {};  ///< [D] mean velocity; absent: 0

  bool operator==(const Puff&) const = default;
};

/// Throws UserError if a puff is impossible in the scene. `place_of` is the place of a key in the
/// user's input.
void check_puff(
    const Puff& puff, const Scene& scene,
    const std::function<Place(std::string_view key)>& place_of = [](auto) { return Place(); });

/// Number of the scene's particles just before one of its changes, an index into Scene::changes.
std::int64_t count_at(const Scene& scene, std::size_t change);
/// Number of the scene's particles after all its puffs.
std::int64_t final_count(const Scene& scene);

}  // namespace clatter
