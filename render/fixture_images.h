#pragma once

#include <array>
#include <vector>

#include "engine/picture/snapshot.h"

namespace clatter {

/// First and last shift, in periods, by which the images of an interval reach into `drawn`. There
/// are none if the first is larger. Without a period the shift is 0.
std::array<int, 2> image_shifts(const std::array<double, 2>& interval, double period, bool periodic,
                                const std::array<double, 2>& drawn);

/// The parts of an interval between openings, which do not overlap.
std::vector<std::array<double, 2>> closed_parts(const std::array<double, 2>& interval,
                                                std::vector<std::array<double, 2>> openings);

/// The closed parts of a partition of disks along its axis, from end to end of `drawn`. Periodic
/// images of its holes are open.
std::vector<std::array<double, 2>> closed_segments(const Partition& partition,
                                                   const Snapshot& snapshot,
                                                   const std::array<double, 2>& drawn);

/// A rectangle on the other two axes of a partition, in order.
struct PlatePart {
  Vec2 low, high;
};

/// The closed rectangles that form a partition of spheres in the box.
std::vector<PlatePart> closed_rectangles(const Partition& partition, const Snapshot& snapshot);

}  // namespace clatter
