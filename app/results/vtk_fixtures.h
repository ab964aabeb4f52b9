#pragma once

#include <string>
#include <vector>

#include "engine/laws/fixture.h"

namespace clatter {

/// The shapes of fixtures as a file of VTK PolyData: lines and polygons in 2D, surfaces in 3D.
/// Round ones have flat parts. Each cell has the number of its fixture. The file contains `origin`,
/// which must not contain "--".
template <int D>
std::string fixture_shapes(const std::vector<Fixture<D>>& fixtures, const std::string& origin);

}  // namespace clatter
