#pragma once

#include <cstdint>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/tiling.h"

namespace clatter {

/// A straight part of the path of a disk on the picture, at constant speed.
struct Chord {
  std::uint32_t disk = 0;
  Vec2 start = {0.0, 0.0}, end = {0.0, 0.0};  ///< centre of the disk, drawn pixels
  double from = 0.0, to = 0.0;                ///< times relative to the snapshot, from < to <= 0
};

/// The visible paths of the disks of these flights and of their periodic images in all copies of
/// the box over the last `time`. Chords deviate from a parabola by at most 1/16 pixel.
std::vector<Chord> chords(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                          const Projection& projection, double time, const Tiling& tiling = {});

}  // namespace clatter
