#pragma once

#include <cstddef>
#include <vector>

#include "engine/vec.h"
#include "render/palette.h"

namespace clatter {

/// The colour of the lines and of the edges of the markers of a series, by its number from 0.
Colour series_ink(std::size_t series);

/// The colour inside of the markers of a series.
Colour marker_fill(std::size_t series);

/// The corners of a marker of a series. Its area is about that of a circle of this radius, in
/// pixels; empty: a circle.
std::vector<Vec2> marker_corners(std::size_t series, Vec2 centre, double radius);

}  // namespace clatter
