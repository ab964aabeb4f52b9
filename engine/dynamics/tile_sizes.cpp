#include "engine/dynamics/tile_sizes.h"

#include <algorithm>

namespace clatter {

// Measured on two cores. Spheres have about one copy for each own particle: 10^6 at phi = 0.3 have
// half the rate of the whole.
bool runs_in_tiles(int dimension, std::size_t particles, int threads) {
  constexpr std::size_t kLeast = 100'000, kLeastAlone = 10'000'000;
  return dimension == 2 && particles >= (threads > 1 ? kLeast : kLeastAlone);
}

// Measured for N = 250,000 and 10^6 at phi = 0.5: two threads take up to 1.2 times as long as the
// whole. From the processor time of the parts, four take about three quarters of its time.
bool watched_runs_in_tiles(int threads) {
  return threads >= 4;
}

TileSizes tile_sizes(std::size_t particles, double fraction, int threads) {
  constexpr double kTilesPerThread = 4.0;
  constexpr double kHaloOfFraction = 4.5;  // measured at 0.1 and 0.3
  constexpr double kDilute = 0.2;          // measured at 0.1 and 0.3
  TileSizes sizes;
  if (fraction < kDilute) sizes.collisions = 1.5;
  sizes.halo = std::max(sizes.halo, kHaloOfFraction / fraction);
  sizes.particles =
      std::min(sizes.particles, static_cast<double>(particles) / (kTilesPerThread * threads));
  return sizes;
}

}  // namespace clatter
