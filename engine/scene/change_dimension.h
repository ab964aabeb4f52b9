#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// A scene in another dimension.
struct ChangedDimension {
  Scene scene;
  std::vector<std::string> removed;  ///< keys of the former scene that have no meaning any more
};

/// The scene with the same number of particles as disks (2) or spheres (3). A depth is added, equal
/// to the height, with a periodic border; or the depth is removed. The box is then scaled so that
/// the particles fill the same share of it, at most `kMostFilled`, with sides in tenths of a
/// diameter. A start state from a file becomes a random one of its temperature. Fixtures keep their
/// places relative to the sides; holes and boxes get all of the depth. Throws UserError if
/// the walls move too far for the box.
ChangedDimension change_dimension(const Scene& scene, int dimension);

/// Largest packing fraction after a change of dimension.
inline constexpr double kMostFilled = 0.4;

}  // namespace clatter
