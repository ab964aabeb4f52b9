#pragma once

#include <optional>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/drawn_region.h"
#include "render/eye.h"

namespace clatter {

/// The obstacles of spheres as they are drawn: with their periodic images, cut at the sides of the
/// box and by the planes of a slab.
struct Bodies {
  /// A ball, or an image of it.
  struct Ball {
    Vec3 centre;
    double radius;
    std::size_t obstacle;  ///< its number in the snapshot
  };
  /// The drawn part of a box.
  struct Block {
    Vec3 low, high;
    std::size_t obstacle;  ///< its number in the snapshot
  };

  DrawnRegion region;  ///< outside of which nothing is drawn
  std::vector<Ball> balls;
  std::vector<Block> blocks;

  /// Whether a body is between a position and the viewer.
  bool hide(const Vec3& position, const Eye& eye) const;
};

/// The region in which fixtures are drawn: between the sides of the box, in the slab.
DrawnRegion fixture_region(const Snapshot& snapshot, const std::optional<Slab>& slab);

/// The bodies of a snapshot.
Bodies bodies_of(const Snapshot& snapshot, const std::optional<Slab>& slab);

}  // namespace clatter
