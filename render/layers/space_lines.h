#pragma once

#include "engine/publish/snapshot.h"
#include "render/layers/disk_colours.h"
#include "render/layers/line_layer.h"

namespace clatter {

/// Adds the paths of the spheres over the last `time`, in the colours of the spheres. They fade out
/// with age. `width` is in drawn pixels.
void add_trails(LineLayer& lines, const Snapshot& snapshot, const DiskColours& colours, double time,
                double width);

/// Adds the arrows of a map, each centred on its cell. `scale` is the length of an arrow in world
/// units per unit of its value; no arrow is longer than two cells.
void add_arrows(LineLayer& lines, const ArrowMap& map, const Eye& eye, double scale, double width,
                Colour colour);

}  // namespace clatter
