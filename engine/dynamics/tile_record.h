#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/event.h"
#include "engine/vec.h"

namespace clatter {

/// A collision of a particle with a partner, found before the run reaches its time.
template <int D>
struct ForeseenEvent {
  Event event;  ///< with original numbers; the partner is a particle, a wall or a piece
  std::uint32_t flight = 0;             ///< number of the particle's flight that ends here
  std::uint32_t partner_flight = 0;     ///< the same of the partner; 0 for a wall
  IntVec<D> image = IntVec<D>::Zero();  ///< as Plan::image
};

/// Added to the number of a flight that leaves a tile, so that it is no flight of the gas.
inline constexpr std::uint32_t kNoFlight = std::uint32_t{1} << 31;

/// The particles of a tile, and the record of its run.
template <int D>
struct TileRecord {
  /// A particle's place at the start, and the way from there.
  struct Stray {
    std::array<float, D> home;  ///< from the lower corner of the subdomain
    float squared_way;          ///< to the farthest of its events; along cut axes
  };

  std::array<float, D> cut = {};       ///< 1 along the axes that tiles divide, 0 along others
  std::vector<std::uint32_t> numbers;  ///< [n] in the whole gas
  std::vector<std::uint8_t> own;       ///< [n] 1: the tile owns the particle; 0: a copy
  std::vector<Vec<D>> images;          ///< [n] box lengths from the subdomain to each flight
  std::vector<Stray> strays;           ///< [n]
  bool keeps_events = false;           ///< whether `events` grows
  /// Collisions of the tile's own particles in order, with the numbers of the tile. A pair belongs
  /// to the owner of its lower number.
  std::vector<ForeseenEvent<D>> events;
  std::uint64_t pair_collisions = 0;  ///< number of those
  std::uint64_t wall_collisions = 0;  ///< the same with walls
};

}  // namespace clatter
