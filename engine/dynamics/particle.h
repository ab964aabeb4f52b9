#pragma once

#include "engine/physics/flight.h"

namespace clatter {

/// Box side in diameters beyond which a run keeps the rounding errors of positions. There positions
/// are coarser than 2e-12, and short flights of grains near rest would be lost in rounding.
inline constexpr double kLongBox = 16384.0;

/// A particle's stored state. It changes only in the particle's own physical events. In 2D it fills
/// one cache line. Contact kernels read it as a row of doubles, see Candidates.
template <int D>
struct alignas(64) Particle {
  Flight<D> flight;               ///< since its last physical event
  Vec<D> image = Vec<D>::Zero();  ///< whole box lengths from its cell's frame to the flight's frame
};

}  // namespace clatter
