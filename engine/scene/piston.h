#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/error.h"
#include "engine/scene/scene.h"

namespace clatter {

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
