#include "engine/dynamics/tile_sizes.h"

#include <algorithm>

namespace clatter {

// Measured on two cores. Spheres have about one copy for each own particle: 10^6 at phi = 0.3 have
// half the rate of the whole.
bool runs_in_tiles(int dimension, std::size_t particles, int threads) {
  constexpr std::size_t kLeast = 100'000, kLeastAlone = 10'000'000;
  return dimension == 2 && particles >= (threads > 1 ? kLeast : kLeastAlone);
}

// Measured on two cores, phi = 0.5, restitution 0.9, with the sums of a measurement, rates relative
// to the whole: 0.8 to 1.0 for N = 100,000, 1.0 to 1.3 for 250,000, 1.2 to 1.4 from 500,000 on.
// From the processor time of the parts, four threads gain in all of them.
bool watched_runs_in_tiles(std::size_t particles, int threads) {
  constexpr std::size_t kLeastOnTwo = 250'000;
  return threads >= 4 || (threads >= 2 && particles >= kLeastOnTwo);
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
