#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/layers/disk_colours.h"
#include "render/layers/line_layer.h"

namespace clatter {

/// The paths of the spheres of these flights over the last `time`, in the colours of the spheres.
/// They fade out with age. `width` is in drawn pixels.
std::vector<Line> trail_lines(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                              const DiskColours& colours, double time, double width);

/// The arrows of a map, each centred on its cell. `scale` is the length of an arrow in world units
/// per unit of its value; no arrow is longer than two cells. `width` is in drawn pixels.
std::vector<Line> arrow_lines(const ArrowMap& map, const Eye& eye, double scale, double width,
                              Colour colour);

}  // namespace clatter
