#pragma once

#include <cstddef>

namespace clatter {

/// Sizes of tiles and windows of Foresight. They affect the speed only.
struct TileSizes {
  double particles = 16'000.0;  ///< that a tile owns
  double collisions = 2.0;      ///< of a particle in a window
  double halo = 10.0;           ///< width of the first halos, in diameters
};

/// Whether a gas of so many particles runs faster in tiles than as a whole, as far as measured.
bool runs_in_tiles(int dimension, std::size_t particles, int threads);

/// Whether that holds also if an observer or the detection of collapse needs the events in order.
/// One thread then processes all events, and fewer threads gain less than it costs.
bool watched_runs_in_tiles(int threads);

/// The best sizes for a gas of so many particles that fill a fraction of the box: each thread has
/// several tiles. Influence travels farther in a dilute gas.
TileSizes tile_sizes(std::size_t particles, double fraction, int threads);

}  // namespace clatter
