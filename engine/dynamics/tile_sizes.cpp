#include "engine/dynamics/tile_sizes.h"

#include <algorithm>

namespace clatter {

// Measured on two cores. Spheres have about one copy for each own particle: 10^6 at phi = 0.3 have
// half the rate of the whole.
bool runs_in_tiles(int dimension, std::size_t particles, int threads) {
  constexpr std::size_t kLeast = 100'000, kLeastAlone = 10'000'000;
  return dimension == 2 && particles >= (threads > 1 ? kLeast : kLeastAlone);
}

// `clatter measure` of 10^6 disks, phi = 0.5, restitution 0.9, on two threads has 1.01 to 1.17
// times the rate of the whole, with fields 0.96, for 1.5 times the processor time. From the
// processor time of the parts, four threads pay.
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
