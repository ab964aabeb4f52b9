#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/error.h"
#include "engine/scene/scene.h"

namespace clatter {

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

/// Throws UserError if a puff is impossible in the scene. `place_of` is the place of a key in the
/// user's input.
void check_puff(
    const Puff& puff, const Scene& scene,
    const std::function<Place(std::string_view key)>& place_of = [](auto) { return Place(); });

/// Number of the scene's particles just before one of its changes, an index into Scene::changes.
std::int64_t count_at(const Scene& scene, std::size_t change);
/// Number of the scene's particles after all its puffs.
std::int64_t final_count(const Scene& scene);

/// Least position of the piston: the right wall then leaves room for one particle. A stroke ends
/// above it, and not above the size of the box along x.
double least_piston_position(const Scene& scene);

/// Throws UserError if a stroke of the piston among the scene's changes is impossible, or begins
/// before another has ended. `place_of` is the place of a key of a change in the user's input.
void check_pistons(
    const Scene& scene,
    const std::function<Place(std::size_t change, std::string_view key)>& place_of =
        [](auto, auto) { return Place(); });

/// Time from which the piston may begin another stroke, and its position there.
struct PistonPlan {
  double time = 0.0;
  double position = 0.0;
};

/// The end of the strokes that follow each other from `time` on. Without a stroke then, it is at
/// `time` and `position`.
PistonPlan piston_plan(const std::vector<Change>& changes, double time, double position);

/// Packing fraction after all puffs, with the piston at its innermost position among the scene's
/// changes.
double compressed_fraction(const Scene& scene);

}  // namespace clatter
