#pragma once

#include <cstddef>
#include <optional>

#include "engine/picture/snapshot.h"
#include "render/eye.h"

namespace clatter {

/// A position of a snapshot in three dimensions; z = 0 for disks.
Vec3 in_space(const VecX& position);

/// The position of the periodic image of a particle that is nearest to a position.
VecX nearest_image(const Snapshot& snapshot, const VecX& position, const VecX& particle);

/// The particle at a drawn pixel; absent: none. Of spheres it is the one in front among the visible
/// parts, where a slab and periodic borders cut, and bodies hide others. Faint parts beyond
/// periodic borders come last.
std::optional<std::size_t> particle_at(const Snapshot& snapshot, const Eye& eye, const Vec2& pixel,
                                       const std::optional<Slab>& slab);

}  // namespace clatter
