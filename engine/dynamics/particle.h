#pragma once

#include "engine/physics/flight.h"

namespace clatter {

/// Box side in diameters beyond which a run keeps what its positions lose in rounding: there they
/// are coarser than 2e-12, and grains that rattle would lose the way of each short flight.
inline constexpr double kLongBox = 16384.0;

/// A particle's stored state: it changes only in the particle's own physical events, and in 2D it
/// fills one cache line. Contact kernels read it as a row of doubles, see Candidates.
template <int D>
struct alignas(64) Particle {
  Flight<D> flight;               ///< since its last physical event
  Vec<D> image = Vec<D>::Zero();  ///< whole box lengths by which its cell lies off flight's frame
};

}  // namespace clatter
