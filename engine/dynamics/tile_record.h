#pragma once

#include <cstdint>
#include <vector>

#include "engine/dynamics/foreseen_event.h"
#include "engine/vec.h"

namespace clatter {

/// Added to the number of a flight that leaves a tile, so that it is no flight of the gas.
inline constexpr std::uint32_t kNoFlight = std::uint32_t{1} << 31;

/// The particles of a tile, and the record of its run.
template <int D>
struct TileRecord {
  /// A particle of the tile or of its halo.
  struct Member {
    std::uint32_t number = 0;  ///< in the whole gas
    bool own = false;          ///< whether the tile owns it; others are copies
    Vec<D> home = Vec<D>::Zero();   ///< position at the start, in the subdomain's frame
    Vec<D> image = Vec<D>::Zero();  ///< box lengths from this frame to the frame of its flight
    double strayed = 0.0;  ///< squared distance from home, the largest at its events
  };

  Vec<D> cut = Vec<D>::Zero();  ///< 1 along the axes that tiles divide; distances count these
  std::vector<Member> members;  ///< by ascending number
  std::vector<ForeseenEvent<D>> events;  ///< of the tile's own particles, in order
};

}  // namespace clatter
