#pragma once

#include <cstdint>

#include "engine/dynamics/event.h"
#include "engine/vec.h"

namespace clatter {

/// A collision of a particle with a partner, found before the run reaches its time.
template <int D>
struct ForeseenEvent {
  Event event;                          ///< with original numbers; a particle or a wall as partner
  std::uint32_t flight = 0;             ///< number of the particle's flight that ends here
  std::uint32_t partner_flight = 0;     ///< the same of the partner; 0 for a wall
  IntVec<D> image = IntVec<D>::Zero();  ///< as Plan::image
};

}  // namespace clatter
