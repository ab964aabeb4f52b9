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

/// A change of velocities at one time, of one particle or of the particles whose centres are in a
/// region. It has one of `scale`, `add` and `set`. Positions and spins remain.
struct Nudge {
  std::optional<int> particle = {};   ///< number of the particle; absent: those of the region
  std::optional<VecX> centre = {};    ///< [D] centre of the region, a disk or a ball, in the box
  std::optional<double> radius = {};  ///< of the region, > 0; across periodic sides as well
  std::optional<double> scale = {};   ///< factor >= 0 of velocities relative to the region's mean
  std::optional<VecX> add = {};       ///< [D] velocity that is added
  std::optional<VecX> set = {};       ///< [D] new velocity

  bool operator==(const Nudge&) const = default;
};

/// Throws UserError if a vector of a change has another size than the box. `owner` is the change,
/// such as "nudge", and `place` the place of the key in the user's input.
void check_size(const VecX& vector, const Scene& scene, std::string_view owner,
                std::string_view key, const Place& place);

/// Throws UserError if the centre of a region is outside of the scene's box. Its size is right.
void check_centre(const VecX& centre, const Scene& scene, std::string_view owner,
                  const Place& place);

/// Throws UserError if keys of a nudge are missing, or impossible in a gas of `count` particles in
/// the scene's box. `place_of` is the place of a key in the user's input.
void check_nudge(
    const Nudge& nudge, const Scene& scene, std::int64_t count,
    const std::function<Place(std::string_view key)>& place_of = [](auto) { return Place(); });

/// The same for all nudges among the scene's changes. `place_of` is the place of a key of the nudge
/// of a change.
void check_nudges(
    const Scene& scene,
    const std::function<Place(std::size_t change, std::string_view key)>& place_of =
        [](auto, auto) { return Place(); });

}  // namespace clatter
